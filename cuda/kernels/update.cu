#include "cuda/kernels/kernels.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/runtime/launch.h"

namespace pl::cuda {
namespace {

/// One launch per step, since a step reads results of the previous one for other cells of the same volume.
template <auto kStep>
__global__ void __launch_bounds__(kThreadsPerBlock)
    run_step(const __grid_constant__ TableUpdateView field, std::uint32_t count) {
    const std::uint32_t i = thread_number();
    if (i < count) kStep(field, i);
}

__global__ void __launch_bounds__(kThreadsPerBlock)
    gather_records(const __grid_constant__ TableField field, Span<VolumeRecord> records) {
    const std::uint32_t volume = thread_number();
    if (volume < records.count) records[volume] = gather_record(field, volume);
}

}  // namespace

constinit const GatherRecordsKernel kGatherRecords = gather_records;
constinit const std::array<UpdateStep, kUpdateStepCount> kUpdateSteps = {{
    {run_step<absorb_samples>, UpdateItem::Cell, "absorb_samples"},
    {run_step<update_means>, UpdateItem::Volume, "update_means"},
    {run_step<weigh_row>, UpdateItem::Row, "weigh_row"},
    {run_step<build_row>, UpdateItem::Row, "build_row"},
    {run_step<build_row_choice>, UpdateItem::Volume, "build_row_choice"},
    {run_step<absorb_light_samples<TableUpdateView>>, UpdateItem::Volume, "absorb_light_samples"},
    {run_step<move_mixture>, UpdateItem::Volume, "move_mixture"},
    {run_step<move_reach>, UpdateItem::Volume, "move_reach"},
}};

}  // namespace pl::cuda
