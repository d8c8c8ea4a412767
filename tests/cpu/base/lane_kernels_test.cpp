// Random numbers drawn in SIMD lanes have the bits of the scalar code.
#include <cstring>

#include "core/kernel/methods/default.h"
#include "cpu/paths/batch_paths.h"
#include "tests/support/catch.hpp"
#include "tests/support/same_bits.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;
using test::Uniforms;

namespace {}  // namespace

TEST_CASE("The baseline kernels are there and every usable set is named") {
    REQUIRE_FALSE(usable_lane_kernels().empty());
    CHECK(std::string(usable_lane_kernels().front().isa) == "baseline");
    for (const LaneKernels& kernels : usable_lane_kernels()) UNSCOPED_INFO(kernels.isa);
    SUCCEED();
}

TEST_CASE("Every instruction set draws the bits of Rng") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        Uniforms random(7);
        for (int round = 0; round < 200; ++round) {
            const DrawKey key{(std::uint64_t{random.bits()} << 32) | random.bits(),
                              static_cast<Stream>(random.below(3)), static_cast<Purpose>(random.below(6))};
            CounterGroup counters[2];
            UniformGroup numbers[2];
            for (std::uint32_t i = 0; i < 2 * kGroupSize; ++i) {
                counters[i / kGroupSize].pixel[i % kGroupSize] = random.bits();
                counters[i / kGroupSize].sample[i % kGroupSize] = random.bits();
                counters[i / kGroupSize].vertex[i % kGroupSize] = random.bits() >> 8;
            }
            kernels.draw(key, counters, numbers, 2);
            for (std::uint32_t i = 0; i < 2 * kGroupSize; ++i) {
                const CounterGroup& group = counters[i / kGroupSize];
                const std::uint32_t lane = i % kGroupSize;
                const Rng rng{key.seed, key.stream, group.pixel[lane], group.sample[lane]};
                REQUIRE(same_bits(numbers[i / kGroupSize].get(lane), rng.draw(group.vertex[lane], key.purpose)));
            }
        }
    }
}

TEST_CASE("Every instruction set draws the numbers of vertices as one path alone does, bit by bit") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        Uniforms random(9);
        for (int round = 0; round < 200; ++round) {
            const DrawKey key{(std::uint64_t{random.bits()} << 32) | random.bits(),
                              static_cast<Stream>(random.below(4)),
                              random.below(2) == 0 ? Purpose::Scatter : Purpose::Light,
                              {random.bits() >> random.below(32), random.bits() >> random.below(32)}};
            CounterGroup counters;
            UniformGroup numbers;
            for (std::uint32_t lane = 0; lane < kGroupSize; ++lane) {
                counters.pixel[lane] = random.bits();
                counters.sample[lane] = key.sequences.first_sample + (random.bits() >> random.below(32));
                counters.vertex[lane] = 1 + random.below(2 + round % 2);
            }
            kernels.draw_vertices(key, &counters, &numbers, 1);
            for (std::uint32_t lane = 0; lane < kGroupSize; ++lane) {
                const Rng rng{key.seed, key.stream, counters.pixel[lane], counters.sample[lane]};
                REQUIRE(same_bits(numbers.get(lane),
                                  vertex_uniforms(rng, key.sequences, counters.vertex[lane], key.purpose)));
            }
        }
    }
}

TEST_CASE("A batch of numbers gives the numbers of a vertex alone") {
    constexpr FeatureSet kLights = FeatureSet{}.with(Feature::NextEventEstimation);
    const PathSettings settings{.seed = 0x123456789abcdef0u, .sequences = {20, 77}, .next_event = 1};
    Uniforms random(8);
    std::vector<PathState<kLights, DefaultMethod>> states(37);
    UniformBatch batch(37, true);
    for (std::uint32_t i = 0; i < 37; ++i) {
        states[i].pixel = random.bits();
        states[i].sample = random.bits();
        states[i].vertices = random.below(i % 2 == 0 ? 2 : 64);
        batch.set_path(i, states[i]);
    }
    batch.draw(settings, 37);
    for (std::uint32_t i = 0; i < 37; ++i) {
        const VertexUniforms expected = draw_vertex_uniforms<kLights>(settings, states[i]);
        CHECK(same_bits(batch.scatter_groups()[i / kGroupSize].get(i % kGroupSize), expected.scatter));
        CHECK(same_bits(batch.light_groups()[i / kGroupSize].get(i % kGroupSize), expected.light));
    }
}

TEST_CASE("A source gives every path of the queue with the numbers it starts with") {
    constexpr std::uint32_t kFirst = 100;
    constexpr std::uint32_t kEnd = 100 + 3 * kPathChunk + 17;
    ChunkQueue queue(kFirst, kEnd, kPathChunk);
    PathSource source(queue, {.seed = 5, .stream = Stream::Picture, .purpose = Purpose::Pixel, .sample = 9});
    PathStart start;
    for (std::uint32_t expected = kFirst; expected < kEnd; ++expected) {
        REQUIRE(source.next(start));
        REQUIRE(start.number == expected);
        REQUIRE(same_bits(start.u, Rng{5, Stream::Picture, expected, 9}.draw(0, Purpose::Pixel)));
    }
    CHECK_FALSE(source.next(start));
    CHECK_FALSE(source.next(start));
}

TEST_CASE("Every instruction set makes the camera rays of the scalar code, bit for bit") {
    Camera camera;
    camera.axis = glm::normalize(Vec3f{0.3f, -0.2f, -1.0f});
    camera.center = camera.axis + Vec3f{0.1f, 0.05f, 0.0f};
    camera.right = {0.7f, 0.0f, 0.21f};
    camera.up = {0.1f, 0.6f, -0.1f};
    Uniforms random(7);
    for (const std::uint32_t sample : {0u, 1u, 2u, 17u, 0xffffffffu}) {
        const PixelGrid grid{61, 43, sample};
        CounterGroup counters[3];
        UniformGroup numbers[3];
        for (std::uint32_t i = 0; i < 3 * kGroupSize; ++i) {
            counters[i / kGroupSize].pixel[i % kGroupSize] = random.below(61 * 43);
            const Vec4f u = to_unit_floats(Rng{3, Stream::Picture, i, sample}.bits(0, Purpose::Pixel));
            for (int row = 0; row < 4; ++row) numbers[i / kGroupSize].rows[row][i % kGroupSize] = u[row];
        }
        for (const LaneKernels& kernels : usable_lane_kernels()) {
            VectorGroup directions[3];
            kernels.find_camera_directions(camera, grid, counters, numbers, directions, 3);
            for (std::uint32_t i = 0; i < 3 * kGroupSize; ++i) {
                INFO(kernels.isa << ", sample " << sample << ", ray " << i);
                const Vec4f start = numbers[i / kGroupSize].get(i % kGroupSize);
                const Ray ray = camera_ray<FeatureSet{}>(camera, grid, counters[i / kGroupSize].pixel[i % kGroupSize],
                                                         pixel_sample(start, sample));
                const Vec3f direction = directions[i / kGroupSize].get(i % kGroupSize);
                CHECK(std::memcmp(&direction, &ray.direction, sizeof direction) == 0);
            }
        }
    }
}
