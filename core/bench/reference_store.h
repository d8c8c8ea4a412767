// References on disk: converged pictures in two independent halves, found by the hash of everything that decides their
// light, so that a picture of other light is never taken for a reference.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/base/progress.h"
#include "core/io/image.h"
#include "core/io/json_file.h"
#include "core/measure/noise.h"
#include "core/session/session.h"
#include "core/session/settings.h"

namespace pl::bench {

/// Everything that a picture and its reference have in common.
struct PictureContent {
    std::string picture_hash;  ///< picture_hash(): decides; the rest is for messages
    std::string scene_hash;
    int width = 0;
    int height = 0;
    int max_depth = 0;
};

PictureContent content_of(const std::string& scene_hash, const RenderSettings& settings);

/// One half, with an .exr file of its own.
struct ReferenceHalf {
    LinearImage image;
    std::uint32_t spp = 0;
    std::uint32_t parts = 0;  ///< stretches of passes, each with random numbers of its own
    double seconds = 0.0;
};

struct Reference {
    std::string name;  ///< of its files: scene and hash
    PictureContent content;
    std::array<ReferenceHalf, 2> halves;

    PictureHalves pixels() const { return {halves[0].image.pixels, halves[1].image.pixels}; }
    LinearImage mean() const;  ///< of both halves, weighted by their samples
    Noise noise() const;       ///< of the mean of both halves, weighted equally
    bool has_samples() const { return halves[0].spp > 0 && halves[1].spp > 0; }
};

/// A folder of references: NAME-HASH.json, the manifest, beside NAME-HASH-1.exr and NAME-HASH-2.exr.
class ReferenceStore {
public:
    explicit ReferenceStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& folder() const { return folder_; }

    /// The reference of this content; its halves may hold different numbers of samples, also none. Throws
    /// Error(Input) for files that are damaged or whose content differs from the one in their name.
    std::optional<Reference> find(const PictureContent& content) const;
    /// The same, but throws Error(Input) if it is missing or without samples; the message lists the pictures with
    /// references in the folder.
    Reference require(const PictureContent& content) const;

    /// Writes one half; a later run continues from it.
    void save_half(const Reference& reference, std::size_t half) const;
    /// Writes the manifest: `about` and the figures of both halves.
    std::filesystem::path save_manifest(const Reference& reference, const Json& about) const;

private:
    std::filesystem::path half_path(const std::string& name, std::size_t half) const;
    ReferenceHalf load_half(const std::filesystem::path& path, const PictureContent& content) const;
    std::string other_contents(const PictureContent& content) const;

    std::filesystem::path folder_;
};

inline constexpr std::string_view kReferenceSchema = "pathlight.reference/1";
/// Metadata of a half: "1" or "2".
inline constexpr const char* kReferenceHalfKey = "reference_half";

// Rendering a reference: both halves in turns, saved as they grow.

struct ReferenceOutcome {
    Reference reference;
    std::filesystem::path manifest;
    bool interrupted = false;
};

struct ReferencePlan {
    std::string scene;              ///< as its user names it, for the manifest
    std::uint32_t spp = 0;          ///< samples per pixel in each half
    std::optional<double> seconds;  ///< limit of this call
    bool in_both_halves = false;    ///< `stop` waits until each half has a sample
    const StopFlag* stop = nullptr;
    std::function<void(const ProgressState&)> show{};  ///< after each pass; may be empty
};

/// Continues the reference that the store holds until both halves have `plan.spp` samples per pixel or the time limit is
/// over, with at least one sample in each half unless stopped. A crash loses at most the last ten seconds, an interruption
/// nothing. Changes the session's seed: each half, and each stretch of passes, has random numbers of its own.
ReferenceOutcome make_reference(Session& session, const ReferencePlan& plan, const ReferenceStore& store);

}  // namespace pl::bench
