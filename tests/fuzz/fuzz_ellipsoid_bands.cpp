// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_bands.h"
#include "input.h"
#include <numeric>

using namespace grainscope;
using Eigen::Vector3d;
using fuzz::require;
using fuzz::require_below;

namespace {

double sum(const std::vector<double> &numbers) { return std::accumulate(numbers.begin(), numbers.end(), 0.0); }

void angle_of_anything(fuzz::Input &input, int bands) {
  const Vector3d x(input.any(), input.any(), input.any()),
      semi(std::fabs(input.any()), std::fabs(input.any()), std::fabs(input.any()));
  for (SurfaceAngle kind : {SurfaceAngle::polar, SurfaceAngle::parametric}) {
    const double psi = surface_angle(x, semi, kind);
    const int band = band_of(psi, bands);
    require(std::isnan(psi) ? band == -1 : band >= 0 && band < bands,
            "a band is one of those there are, or none of what is no angle", band);
  }
}

}

/** Every point that is one is in a band; their areas add up to the area of the ellipsoid, however it is divided. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  angle_of_anything(input, input.whole(1, 1000));
  const bool round = input.byte() < 240;  // others take a hundred times as long
  const double a = input.logarithmic(0.02, 50.0), unit = std::pow(10.0, input.whole(-6, 6));
  const Vector3d semi = unit * Vector3d(a, round ? a : input.logarithmic(0.1, 10.0), 1.0);
  const int bands = round ? input.whole(1, 60) : input.whole(1, 4);

  const std::vector<double> polar = band_areas(semi, bands, SurfaceAngle::polar),
                            parametric = band_areas(semi, bands, SurfaceAngle::parametric);
  for (const auto *areas : {&polar, &parametric})
    for (double area : *areas) require(area > 0.0 && std::isfinite(area), "an area is positive", area);
  const double area = sum(polar);
  require_below(std::fabs(sum(parametric) / area - 1.0), 1e-10, "both angles divide the same area");
  const double p = 1.6075, mean = (std::pow(semi[0] * semi[1], p) + std::pow(semi[0] * semi[2], p) +
                                   std::pow(semi[1] * semi[2], p)) /
                                  3.0;
  require_below(std::fabs(4.0 * M_PI * std::pow(mean, 1.0 / p) / area - 1.0), 0.0125,
                "an ellipsoid's area is Thomsen's to 1.2 %");
  return 0;
}
