#include "tests/parity/launch_timer.h"

#include "cuda/kernels/kernels.h"

namespace pl::parity {
namespace {

struct KernelName {
    std::string name;
    Work work = Work::Other;
};
using KernelNames = std::map<const void*, KernelName>;

template <class Kernel>
void add_kernel(KernelNames& names, Kernel kernel, const std::string& name, Work work) {
    names[reinterpret_cast<const void*>(kernel)] = {name, work};
}
template <class Kernel>
void add_row(KernelNames& names, const KernelRow<Kernel>& row, const std::string& name) {
    for (std::size_t set = 0; set < row.size(); ++set)
        add_kernel(names, row[set], name + " set " + std::to_string(kCompiledSets[set].bits), Work::Trace);
}

/// All kernels of kernels.h. Sets that share a kernel have the name of the largest.
KernelNames all_kernels() {
    KernelNames names;
    any_method_kernel([&]<int kEntry>() {
        using Kernel = TypeAt<kEntry, MethodList>;
        add_row(names, cuda::picture_kernels<kEntry>(),
                "trace_paths " + std::string(Kernel::Info::kInfo.name) + " entry " + std::to_string(kEntry));
        return false;
    });
    add_row(names, cuda::kProbeKernels, "trace_paths probes");
    add_row(names, cuda::kViewKernels, "show_view");
    add_row(names, cuda::kEmissionKernels, "refine_film");
    add_row(names, cuda::kBorderKernels, "mark_borders");
    add_kernel(names, cuda::kVolumeValues, "volume_values", Work::Publish);
    add_kernel(names, cuda::kAddSamples, "add_samples", Work::Publish);
    add_kernel(names, cuda::kSetSamples, "set_samples", Work::Publish);
    add_kernel(names, cuda::kReadFilm, "read_film", Work::Publish);
    add_kernel(names, cuda::kReadHalves, "read_halves", Work::Publish);
    add_kernel(names, cuda::kShowFilm, "show_film", Work::Publish);
    add_kernel(names, cuda::kLargestValue, "largest_value", Work::Publish);
    add_kernel(names, cuda::kGatherRecords, "gather_records", Work::Learn);
    for (const cuda::UpdateStep& step : cuda::kUpdateSteps)
        add_kernel(names, step.kernel, std::string("run_step ") + step.name, Work::Learn);
    return names;
}

KernelName name_of(const KernelNames& names, const QueuedWork& work) {
    if (work.kernel == nullptr) return {"copy", Work::Copy};
    const auto found = names.find(work.kernel);
    return found == names.end() ? KernelName{"other", Work::Other} : found->second;
}

}  // namespace

const char* name_of(Work work) {
    switch (work) {
    case Work::Trace: return "trace";
    case Work::Learn: return "learn";
    case Work::Publish: return "publish";
    case Work::Copy: return "copy";
    case Work::Other: return "other";
    }
    return "unknown";
}

LaunchTimer::Event LaunchTimer::record_event(cudaStream_t stream) {
    cudaEvent_t event = nullptr;
    cuda::check(cudaEventCreateWithFlags(&event, 0), "creating an event");
    Event owner(event);
    cuda::check(cudaEventRecord(event, stream), "recording an event");
    return owner;
}

LaunchTimer::LaunchTimer() {
    set_launch_hooks({.before =
                          [this](const QueuedWork& work) {
                              timed_.push_back({work, record_event(work.stream), {}});
                          },
                      .after = [this](const QueuedWork& work) { timed_.back().end = record_event(work.stream); }});
}

LaunchTimer::~LaunchTimer() { set_launch_hooks({}); }

std::map<std::string, WorkTime> LaunchTimer::times() const {
    static const KernelNames names = all_kernels();
    std::map<std::string, WorkTime> times;
    for (const TimedWork& timed : timed_) {
        cuda::check(cudaEventSynchronize(timed.end.get()), "timing a kernel");
        float milliseconds = 0.0f;
        cuda::check(cudaEventElapsedTime(&milliseconds, timed.start.get(), timed.end.get()), "reading two events");
        const KernelName named = name_of(names, timed.work);
        WorkTime& time = times[named.name];
        time.work = named.work;
        ++time.count;
        time.milliseconds += static_cast<double>(milliseconds);
        time.bytes += timed.work.bytes;
    }
    return times;
}

}  // namespace pl::parity
