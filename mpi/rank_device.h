// Which GPU a rank uses: the ranks of a machine take its devices in turns.
#pragma once

#include <filesystem>
#include <string>

namespace pl {

/// The value of CUDA_VISIBLE_DEVICES that leaves a rank one device, whose number is the number of the rank on its
/// machine modulo the number of devices: among the devices that the variable lists so far, or among `devices` devices
/// if `visible` is null. Empty where there is nothing to choose: without devices, and where the variable hides them
/// all.
std::string visible_device(const char* visible, int devices, int rank_on_machine);

/// Number of NVIDIA devices whose files are in a folder; the driver is not asked, since it reads the variable when it starts.
int count_device_files(const std::filesystem::path& folder);

/// To be called before anything starts CUDA. Sets the variable for this process; leaves it alone if its job has no other rank on this
/// machine.
void choose_device();

}  // namespace pl
