// SPDX-License-Identifier: GPL-2.0-or-later
#include "host_box.h"
#include "domain.h"
#include <algorithm>

namespace grainscope {

HostBox HostBox::of(const LAMMPS_NS::Domain *domain) {
  HostBox box;
  std::copy(domain->boxlo, domain->boxlo + 3, box.low);
  std::copy(domain->boxhi, domain->boxhi + 3, box.high);
  const double tilts[3] = {domain->yz, domain->xz, domain->xy};
  for (int k = 0; k < 3; k++) box.tilts[k] = domain->triclinic ? tilts[k] : 0.0;
  std::copy(domain->h_rate, domain->h_rate + 6, box.rates);
  std::copy(domain->h_ratelo, domain->h_ratelo + 3, box.low_rates);
  return box;
}

void HostBox::set(LAMMPS_NS::Domain *domain) const {
  std::copy(low, low + 3, domain->boxlo);
  std::copy(high, high + 3, domain->boxhi);
  if (domain->triclinic) {
    domain->yz = tilts[0];
    domain->xz = tilts[1];
    domain->xy = tilts[2];
  }
  std::copy(rates, rates + 6, domain->h_rate);
  std::copy(low_rates, low_rates + 3, domain->h_ratelo);
  domain->set_global_box();
}

void HostBox::wrap(const int n[3], double position[3], double *velocity) const {
  double edges[3];
  for (int k = 0; k < 3; k++) edges[k] = high[k] - low[k];
  position[0] -= n[0] * edges[0] + n[1] * tilts[2] + n[2] * tilts[1];
  position[1] -= n[1] * edges[1] + n[2] * tilts[0];
  position[2] -= n[2] * edges[2];
  if (!velocity) return;
  velocity[0] -= n[0] * rates[0] + n[1] * rates[5] + n[2] * rates[4];
  velocity[1] -= n[1] * rates[1] + n[2] * rates[3];
  velocity[2] -= n[2] * rates[2];
}

}
