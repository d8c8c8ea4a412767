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
    {run_step<publish_mean>, PublicationItem::Volume, "publish_mean"},
    {run_step<weigh_cell>, PublicationItem::Cell, "weigh_cell"},
    {run_step<sum_row>, PublicationItem::Row, "sum_row"},
    {run_step<build_row>, PublicationItem::Row, "build_row"},
    {run_step<build_row_choice>, PublicationItem::Volume, "build_row_choice"},
}};

}  // namespace pl::cuda
