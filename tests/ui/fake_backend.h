// A back end for tests of the code around it: paints a value per pass, counts, can be held during a pass, and can
// fail. Two of them represent CPU and CUDA.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "core/scene/description.h"
#include "core/session/backend.h"

namespace pl::test {

/// State shared by a test and the back end on the render thread.
struct FakeControl {
    std::atomic<bool> hold{false};          ///< passes do not end until they are stopped or released
    std::atomic<bool> inside{false};        ///< a pass is held
    std::atomic<bool> finishes{false};      ///< the stop flag comes after the last path: passes are complete
    std::atomic<bool> fail{false};          ///< the next pass throws
    std::atomic<bool> fail_upload{false};   ///< the next upload of a scene throws
    std::atomic<bool> fail_making{false};   ///< making the next back end throws
    std::atomic<bool> lost{false};          ///< every call throws
    std::atomic<bool> hold_upload{false};   ///< the upload of a scene does not end until it is released
    std::atomic<bool> uploading{false};     ///< a scene is held
    std::atomic<int> made{0};               ///< back ends that were made
    std::atomic<int> alive{0};              ///< of them, those that still exist
    std::atomic<int> stopped{0};            ///< passes ended by the stop flag
    std::atomic<int> passes{0};             ///< passes that were complete
    std::atomic<int> bad_pixel{-1};         ///< its samples of pictures are invalid
    std::atomic<int> pass_microseconds{0};  ///< of a picture of 64x64; others in proportion to their pixels

    void keep_tables(std::map<MethodId, HostTables>& where, MethodId method, const HostTables& tables) {
        const std::lock_guard lock(mutex);
        where[method] = tables;
    }
    HostTables tables_in(const std::map<MethodId, HostTables>& where, MethodId method) {
        const std::lock_guard lock(mutex);
        const auto found = where.find(method);
        return found != where.end() ? found->second : HostTables{};
    }
    std::mutex mutex;
    std::map<MethodId, HostTables> uploaded;    ///< the newest of each method to be uploaded; read by tables_in()
    std::map<MethodId, HostTables> downloaded;  ///< the newest of each method to be downloaded
};

inline bool same_tables(const HostTables& a, const HostTables& b) {
    bool same = true;
    zip(a, b, [&](const auto& left, const auto& right) { same = same && left == right; });
    return same;
}

class FakeBackend : public RenderBackend {
public:
    explicit FakeBackend(std::shared_ptr<FakeControl> control, std::string name = "cpu")
        : control_(std::move(control)), name_(std::move(name)) {
        ++control_->made;
        ++control_->alive;
    }
    ~FakeBackend() override { --control_->alive; }

    BackendInfo info() const override { return {name_, "fake " + name_, "none", name_ == "cpu" ? 1 : 0}; }
    void upload_scene(std::shared_ptr<const HostScene>) override {
        require_device();
        control_->uploading = control_->hold_upload.load();
        while (control_->hold_upload) std::this_thread::sleep_for(std::chrono::microseconds(50));
        control_->uploading = false;
        if (control_->fail_upload.exchange(false)) throw std::runtime_error("the scene does not fit");
    }
    void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) override {
        require_device();
        probes_ =
            static_cast<std::uint32_t>(volumes->normals.size()) * static_cast<std::uint32_t>(shape.cells.count());
        tables_.clear();
    }
    void upload_field(MethodId method, HostField field) override {
        require_device();
        control_->keep_tables(control_->uploaded, method, tables_of(field));
        tables_[method] = tables_of(std::move(field));
    }
    HostField download_field(MethodId method) const override {
        require_device();
        control_->keep_tables(control_->downloaded, method, tables_.at(method));
        return tables_.at(method);
    }
    bool has_field(MethodId method) const override { return tables_.count(method) > 0; }
    FieldReport field_report(MethodId method) const override {
        return has_field(method) ? RenderBackend::field_report(method) : FieldReport{};
    }

    void reset_film(FilmSlot slot, int width, int height) override {
        require_device();
        const auto pixels = static_cast<std::size_t>(width * height);
        films_[slot.index()] = {width, height, std::vector<Vec3f>(pixels), std::vector<std::uint32_t>(pixels)};
    }
    FilmReading read_film(FilmSlot slot) const override {
        require_device();
        const Film& film = films_.at(slot.index());
        return {film.width, film.height, film.pixels, 0, 0};
    }
    /// All samples are equal, so the halves are equal, too.
    FilmReading read_halves(FilmSlot slot) const override {
        FilmReading reading = read_film(slot);
        reading.halves = {.mean = {reading.mean, reading.mean}, .weights = {1, 1}};
        return reading;
    }

    std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const override {
        require_device();
        return films_.at(slot.index()).invalid;
    }

    DisplayFrame show_film(FilmSlot slot, const FrameStyle& style) override {
        require_device();
        const Film& film = films_.at(slot.index());
        const ToneTable table(style.curve);
        const auto pixels = std::make_shared<std::vector<std::uint32_t>>();
        for (const Vec3f& value : film.pixels) pixels->push_back(frame_pixel(value, style, table.view()));
        return {film.width, film.height, [pixels] { return pixels->data(); }};
    }
    float largest_value(FilmSlot slot) override {
        require_device();
        float largest = 0.0f;
        for (const Vec3f& value : films_.at(slot.index()).pixels) largest = std::max(largest, value.x);
        return largest;
    }

    PassCounters run_pass(const PassRequest& request) override {
        require_device();
        if (control_->fail.exchange(false)) throw std::runtime_error("the device is gone");
        Film& film = films_.at(request.slot.index());
        const auto pixels = static_cast<std::uint32_t>(film.width * film.height);
        PassCounters counters;
        const std::uint32_t end = std::min(request.end_pixel, pixels);
        wait_in_pass(end - request.first_pixel, request.stop);
        if (request.stop != nullptr && *request.stop && !control_->finishes) {
            ++control_->stopped;
            return counters;
        }
        for (std::uint32_t i = request.first_pixel; i < end; ++i)
            film.pixels[i] = request.slot.view == View::Voronoi ? color_of_id(i % 7) : Vec3f{request.camera.eye.x};
        counters.paths = end - request.first_pixel;
        counters.path.method.records = counters.paths;
        if (const int bad = control_->bad_pixel; bad >= 0 && request.slot.view == View::Beauty) {
            ++film.invalid.at(static_cast<std::size_t>(bad));
            ++counters.invalid_samples;
        }
        record(request);
        if (end == pixels) ++control_->passes;
        return counters;
    }
    PassCounters precompute(const PrecomputeRequest& request) override {
        require_device();
        PassCounters counters;
        wait_in_pass(0, request.stop);
        if (request.stop == nullptr || !*request.stop) counters.paths = probes_ - request.first_probe;
        return counters;
    }
    /// Makes every table depend on all training samples so far.
    void update_field(MethodId method) override {
        require_device();
        HostTables& tables = tables_.at(method);
        for (std::size_t i = 0; i < tables.radiance.size(); ++i) {
            tables.radiance[i] += static_cast<float>(tables.pending_sum[i] % 17);
            tables.visits[i] += tables.pending_count[i];
        }
    }

private:
    struct Film {
        int width = 0;
        int height = 0;
        std::vector<Vec3f> pixels;
        std::vector<std::uint32_t> invalid;
    };

    void require_device() const {
        if (control_->lost) throw std::runtime_error("the device is lost");
    }

    void record(const PassRequest& request) {
        const auto found = tables_.find(request.slot.method);
        if (found == tables_.end() || request.slot.view != View::Beauty) return;
        HostTables& tables = found->second;
        const std::size_t cell = request.sample % tables.pending_sum.size();
        tables.pending_sum[cell] += 3 + request.sample;
        ++tables.pending_count[cell];
    }

    void wait_in_pass(std::uint32_t pixels, const StopFlag* stop) {
        using namespace std::chrono;
        const auto cost = microseconds(static_cast<std::int64_t>(control_->pass_microseconds) * pixels / 4096);
        const auto end = steady_clock::now() + cost;
        while (steady_clock::now() < end && !(stop != nullptr && *stop))
            std::this_thread::sleep_for(microseconds(50));
        // Said within the loop: a pass that is held from now on must not be held unnoticed.
        while (control_->hold && !(stop != nullptr && *stop)) {
            control_->inside = true;
            std::this_thread::sleep_for(microseconds(50));
        }
        control_->inside = false;
    }

    std::shared_ptr<FakeControl> control_;
    std::string name_;
    std::uint32_t probes_ = 0;
    std::map<MethodId, HostTables> tables_;
    std::map<int, Film> films_;
};

/// The back ends of a program, "cpu" and "cuda", as fakes.
struct FakeDevices {
    std::shared_ptr<FakeControl> cpu = std::make_shared<FakeControl>();
    std::shared_ptr<FakeControl> cuda = std::make_shared<FakeControl>();

    auto maker() const {
        return [cpu = cpu, cuda = cuda](const std::string& name) -> std::unique_ptr<RenderBackend> {
            const auto& control = name == "cpu" ? cpu : cuda;
            if (control->fail_making.exchange(false)) throw std::runtime_error("the driver does not answer");
            return std::make_unique<FakeBackend>(control, name);
        };
    }
};

/// Two facing squares: a floor and a light.
inline std::shared_ptr<const SceneDescription> small_scene() {
    auto scene = std::make_shared<SceneDescription>();
    scene->name = "small";
    scene->positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1},
                        {-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};
    MaterialDescription floor;
    floor.name = "floor";
    floor.albedo = glm::vec3{0.5f};
    MaterialDescription light;
    light.name = "light";
    light.emission = glm::vec3{1.0f};
    scene->materials = {floor, light};
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material) {
        TriangleDescription triangle;
        triangle.vertex = {a, b, c};
        triangle.material = material;
        scene->triangles.push_back(triangle);
    };
    add(0, 2, 1, 0);
    add(0, 3, 2, 0);
    add(4, 5, 6, 1);
    add(4, 6, 7, 1);
    scene->camera.eye = {0.0f, 1.0f, 4.0f};
    scene->camera.target = {0.0f, 0.5f, 0.0f};
    return scene;
}

/// True as soon as the condition holds. The end after ten minutes only guards against hanging: no verdict depends on the
/// speed of the machine.
template <class Condition>
bool eventually(Condition&& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return true;
}

}  // namespace pl::test
