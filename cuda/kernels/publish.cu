#include "cuda/kernels/kernels.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/runtime/launch.h"

namespace pl::cuda {
namespace {

/// One launch per step: a step reads what the one before it wrote for other cells of the same volume.
template <auto kStep>
__global__ void __launch_bounds__(kThreadsPerBlock) run_step(FieldPublicationView field, std::uint32_t count) {
    const std::uint32_t i = thread_number();
    if (i < count) kStep(field, i);
}

}  // namespace

constinit const std::array<PublicationStep, kPublicationStepCount> kPublicationSteps = {{
    {run_step<absorb_records>, PublicationItem::Cell, "absorb_records"},
    {run_step<publish_means>, PublicationItem::Volume, "publish_means"},
    {run_step<weigh_row>, PublicationItem::Row, "weigh_row"},
    {run_step<build_row>, PublicationItem::Row, "build_row"},
    {run_step<build_row_choice>, PublicationItem::Volume, "build_row_choice"},
    {run_step<move_mixture>, PublicationItem::Volume, "move_mixture"},
    {run_step<move_reach>, PublicationItem::Volume, "move_reach"},
}};

}  // namespace pl::cuda
