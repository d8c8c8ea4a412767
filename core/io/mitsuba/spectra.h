// Spectra by wavelength as linear colors of sRGB.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

/// Values at wavelengths in nanometers, which rise; linear between them and 0 outside.
struct WavelengthSpectrum {
    std::vector<double> wavelengths, values;
};

/// The color of what is lit, of which a flat spectrum of 1 gives 1, or of what `shines` by itself, of luminance 1. The first one is that
/// under the standard illuminant D65, which is white; the second one of a flat spectrum is reddish. At least 0. [Mitsuba 3, rgb variants]
glm::vec3 color_of(const WavelengthSpectrum& spectrum, bool shines);

/// Radiance of a black body of this temperature in kelvins, in W m^-2 sr^-1 nm^-1. [Planck 1901]
WavelengthSpectrum black_body(double kelvins);

/// A text file of a wavelength and a value in each line; # starts a comment. Throws Error(Input) with file and line.
WavelengthSpectrum read_spectrum(const std::filesystem::path& path);

/// What is wrong with a spectrum, or nothing: no two wavelengths, or not rising ones.
std::string fault_of(const WavelengthSpectrum& spectrum);

}  // namespace pl
