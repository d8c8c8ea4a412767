// Radiance volumes that stay in view beside the selected one, each with a color of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "ui/worker/render_worker.h"

namespace pl::ui {

class PinnedVolumes {
public:
    static constexpr std::size_t kMost = 4;
    /// 0xAABBGGRR, told apart by most color-blind people.   [Okabe and Ito 2008]
    static constexpr std::array<std::uint32_t, kMost> kColors{0xff009fe6u, 0xffe9b456u, 0xff739e00u, 0xffa779ccu};

    explicit PinnedVolumes(RenderWorker& worker) : worker_(worker) {}

    /// Pins a volume, or unpins it. False if all places are taken.
    bool toggle(std::int32_t volume) {
        const auto pinned = std::ranges::find(places_, volume);
        const auto place = pinned != places_.end() ? pinned : std::ranges::find(places_, kNoVolume);
        if (place == places_.end()) return false;
        *place = pinned != places_.end() ? kNoVolume : volume;
        send();
        return true;
    }
    void clear() {
        places_.fill(kNoVolume);
        send();
    }

    /// By color; kNoVolume where no volume is pinned.
    const std::array<std::int32_t, kMost>& places() const { return places_; }
    bool contains(std::int32_t volume) const {
        return volume != kNoVolume && std::ranges::find(places_, volume) != places_.end();
    }

private:
    static constexpr std::array<std::int32_t, kMost> kNone{kNoVolume, kNoVolume, kNoVolume, kNoVolume};

    void send() {
        std::vector<std::int32_t> volumes;
        for (const std::int32_t volume : places_)
            if (volume != kNoVolume) volumes.push_back(volume);
        worker_.set_pins(std::move(volumes));
    }

    RenderWorker& worker_;
    std::array<std::int32_t, kMost> places_ = kNone;
};

}  // namespace pl::ui
