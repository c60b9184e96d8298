// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_contact.h"
#include "fabric.h"
#include "input.h"
#include "nematic.h"
#include "principal_axes.h"
#include <vector>

using namespace grainscope;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using fuzz::require;
using fuzz::require_below;

namespace {

/** Eigenvalues descend and keep the trace; axes are at right angles, point the ruled way, make up the tensor again. */
void check_axes(const Matrix3d &m) {
  const PrincipalAxes principal(m);
  const double size = m.cwiseAbs().maxCoeff(), rounding = 1e-9 * size;
  const Vector3d &values = principal.values;
  const Matrix3d &axes = principal.vectors;
  require(values.allFinite() && axes.allFinite(), "principal axes are finite");
  require(values[0] >= values[1] && values[1] >= values[2], "eigenvalues descend", values[1]);
  require_below(std::fabs(values.sum() - m.trace()), 1e-14 * size * 8.0, "eigenvalues add up to the trace");
  require_below((axes.transpose() * axes - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-8,
                "axes are at right angles");
  require_below((axes * values.asDiagonal() * axes.transpose() - m).cwiseAbs().maxCoeff(), rounding,
                "axes and values make up the tensor");
  for (int k = 0; k < 3; k++)
    require_below(axes.col(k).cwiseAbs().maxCoeff() - axes.col(k).maxCoeff(), 1e-10,
                  "the largest component of an axis is positive");
  const PrincipalAxes again(Matrix3d(values.asDiagonal()));
  require_below((again.values - values).cwiseAbs().maxCoeff(), rounding, "a diagonal tensor has its diagonal");
}

Shape shape_of(unsigned kind) {
  return kind % 3 == 0 ? Shape::prolate : kind % 3 == 1 ? Shape::oblate : Shape::triaxial;
}
bool is_line_angle(double theta) { return theta > -M_PI_2 && theta <= M_PI_2; }

void check_nematic(fuzz::Input &input) {
  NematicSums sums;
  for (int kinds = input.whole(0, 3); kinds > 0; kinds--) {
    const Shape shape = shape_of(input.byte());
    const SymmetryAxis axis{shape, input.whole(0, 2)};
    const int n = input.whole(0, 9);
    std::vector<double> quaternions(4 * n), omega(3 * n);
    for (int k = 0; k < n; k++) input.direction(&quaternions[4 * k], 4);
    for (double &w : omega) w = input.small();
    sums.add_alike(n, axis, quaternions.data(), omega.data());
    if (n == 0) continue;
    Vector3d p;
    rotated_axis(quaternions.data(), axis.index, p.data());
    require(is_line_angle(major_axis_angle(p, shape)), "a grain's angle is in (-pi/2, pi/2]",
            major_axis_angle(p, shape));
    require_below(std::fabs(std::sin(major_axis_angle(p, shape) - major_axis_angle(-p, shape))), 1e-9,
                  "an axis has no head");
  }
  const Nematic nematic(sums);
  require(nematic.order >= -1e-12 && nematic.order <= 1.0 + 1e-12, "S2 is between 0 and 1", nematic.order);
  require_below(std::fabs(nematic.q.trace()), 1e-14, "Q has no trace");
  require(nematic.biaxiality >= 0.0 && nematic.biaxiality <= 1.0 + 1e-12, "biaxiality is between 0 and 1",
          nematic.biaxiality);
  require(is_line_angle(nematic.theta) && is_line_angle(nematic.director_theta), "angles are in (-pi/2, pi/2]",
          nematic.theta);
  check_axes(nematic.q);
}

void check_fabric(fuzz::Input &input) {
  FabricSums sums;
  std::vector<ContactMoment> moments(input.whole(0, 12));
  for (ContactMoment &m : moments) {
    input.direction(m.normal.data(), 3);
    m.weight = input.flag() ? 1.0 : 0.5;
    m.distance = input.logarithmic(1e-3, 1e3);
    m.normal_force = input.small();
    m.tangential_force = input.uniform(0.0, 1.0);
    Contact c;
    c.normal = m.normal;
    c.weight = m.weight;
    sums.add(c);
  }
  const Matrix3d fabric = sums.tensor();
  require_below(std::fabs(fabric.trace() - !moments.empty()), 1e-14, "fabric has trace 1");
  check_axes(fabric);
  require(moments.empty() || PrincipalAxes(fabric).values[2] >= -1e-14, "fabric is not negative");
  WeightedFabricSums weighted;
  for (const ContactMoment &m : moments) weighted.add(m, fabric);
  for (const Matrix3d &m : {weighted.branch(), weighted.normal_force(), weighted.tangential_force()})
    require(m.allFinite(), "weighted tensors are finite");
  require_below(std::fabs(weighted.branch().trace()), 1e-12 * (1.0 + weighted.branch().cwiseAbs().maxCoeff()),
                "the branch tensor has no trace");
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  Matrix3d m;
  const double unit = std::pow(10.0, input.whole(-30, 30));
  for (int a = 0; a < 3; a++)
    for (int b = 0; b <= a; b++) m(a, b) = m(b, a) = unit * input.small();
  check_axes(m);
  for (int a = 0; a < 3; a++)
    for (int b = 0; b <= a; b++) m(a, b) = m(b, a) = input.any();
  PrincipalAxes anything(m);
  check_nematic(input);
  check_fabric(input);
  return 0;
}
