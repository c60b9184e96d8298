// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain_state.h"
#include "checksum.h"
#include "atom.h"
#include <algorithm>
#include <cstddef>

namespace grainscope {

namespace {

/** The numbers of a grain that one checksum is made of. */
class Numbers {
 public:
  void add(const double *values, int n) { count_ = std::copy(values, values + n, numbers_ + count_) - numbers_; }
  void add(double value) { add(&value, 1); }
  double checksum() const { return checksum_as_double(numbers_, count_ * sizeof(double)); }

 private:
  double numbers_[18];
  std::ptrdiff_t count_ = 0;
};

}

double velocity_hash(const LAMMPS_NS::Atom *atom, int i) { return checksum_as_double(atom->v[i], 3 * sizeof(double)); }

double state_hash(const LAMMPS_NS::Atom *atom, int i) {
  Numbers state;
  state.add(atom->omega[i], 3);
  state.add(atom->radius[i]);
  state.add(atom->rmass[i]);
  state.add(atom->type[i]);
  if (atom->superquadric_flag) {
    state.add(atom->quaternion[i], 4);
    state.add(atom->angmom[i], 3);
    state.add(atom->shape[i], 3);
    state.add(atom->blockiness[i], 2);
  }
  return state.checksum();
}

std::uint64_t text_hash(const std::string &text) { return checksum(text.data(), text.size()); }

void edges_crossed(LAMMPS_NS::tagint before, LAMMPS_NS::tagint after, int edges[3]) {
  for (int k = 0; k < 3; k++) {
    const int shift = k == 0 ? 0 : k == 1 ? IMGBITS : IMG2BITS;
    const int n = static_cast<int>(((after >> shift) & IMGMASK) - ((before >> shift) & IMGMASK));
    // Flags count modulo their number of bits.
    edges[k] = n > IMGMAX ? n - (IMGMASK + 1) : n < -IMGMAX ? n + (IMGMASK + 1) : n;
  }
}

}
