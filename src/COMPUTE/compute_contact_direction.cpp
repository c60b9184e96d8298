// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_direction.h"
#include "arguments.h"
#include "contact_sums.h"
#include "direction_sums.h"
#include "plane.h"
#include "rows.h"
#include <algorithm>

using namespace LAMMPS_NS;
using grainscope::DirectionSums;

namespace {

const int width = 9;

}

struct ComputeContactDirection::Impl {
  grainscope::ContactSums<DirectionSums> sums;
  grainscope::Rows rows;
};

ComputeContactDirection::ComputeContactDirection(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg), impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  grainscope::Plane plane;
  int half = 36;  // bins from 0 to pi; the other half is their mirror image
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"plane", "bins"});
    if (keyword == "plane") plane.read(arguments);
    else half = arguments.even_number(keyword, 2, 10000) / 2;
  }
  impl_->sums = grainscope::ContactSums<DirectionSums>(DirectionSums(plane.flow, plane.gradient, half));
  sums_over(impl_->sums);
  array_flag = 1;
  extarray = 0;
  size_array_rows = 2 * half;
  size_array_cols = width;
  array = impl_->rows.resize(size_array_rows, width);
}

ComputeContactDirection::~ComputeContactDirection() {}

void ComputeContactDirection::answer() {
  const DirectionSums &all = impl_->sums.total(*this);
  require_finite(all.not_finite());
  const double contacts = all.contacts(), bin = all.width();
  for (int k = 0; k < 2 * all.bins(); k++) {
    const DirectionSums::Bin s = all.bin(k % all.bins());
    const double per_contact = s.contacts > 0.0 ? 1.0 / s.contacts : 0.0;
    const double row[width] = {(k + 0.5) * bin, s.contacts, contacts > 0.0 ? s.contacts / (2.0 * contacts * bin) : 0.0,
                               s.normal * per_contact, s.tangential * per_contact, s.along * per_contact, s.normal, s.tangential, s.along};
    std::copy(row, row + width, array[k]);
  }
}
