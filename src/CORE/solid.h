// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SOLID_H
#define GRAINSCOPE_SOLID_H

#include "polyhedron.h"
#include <string>
#include <utility>
#include <vector>

namespace grainscope {

/** Parts of a line, disjoint and in order: from 0, its beginning, to 1, its end. */
using LineParts = std::vector<std::pair<double, double>>;

/** Sum of their lengths, of the part from `low` to `high` of the line. */
double length_of(const LineParts &parts, double low = 0.0, double high = 1.0);

/** A region of space: convex bodies, the outside of a body, and intersections and unions of several. */
class Solid {
 public:
  /** What the half spaces have in common: a block, a prism, one side of a plane. */
  static Solid flat(std::vector<HalfSpace> sides);
  static Solid ball(const Eigen::Vector3d &centre, double radius);
  /** A cylinder or a cut cone: round about an axis through `origin` along `axis` (length 1), between the distances lo
   *  and hi from the origin, where its radius is radius_lo and radius_hi. */
  static Solid round(const Eigen::Vector3d &origin, const Eigen::Vector3d &axis, double lo, double hi, double radius_lo,
                     double radius_hi);
  static Solid common(std::vector<Solid> members);
  static Solid united(std::vector<Solid> members);
  /** What is outside of it. */
  Solid complement() const;

  /** Turned about the origin, then shifted. */
  Solid moved(const Eigen::Matrix3d &turn, const Eigen::Vector3d &shift) const;

  /** The parts of the line that lie inside. Solids that share a plane share no line in it. */
  LineParts parts(const Eigen::Vector3d &from, const Eigen::Vector3d &to) const;

  /** Volume of what lies in `box`, exact but for rounding; false and the reason where it is not known: of round bodies
   *  that the box cuts otherwise than across their axis, of what several cover together, of a common part with more
   *  than one round body or with an outside. */
  bool volume_within(const Polyhedron &box, double &volume, std::string &why) const;
  /** Where it is cut by the plane at `height` along z, as a solid that is the same at all z, so that its volume per
   *  length is the area of the cut; false and the reason for round bodies that are not about z. */
  bool section(double height, Solid &cut, std::string &why) const;

 private:
  enum class Kind { flat, ball, round, common, united } kind_ = Kind::flat;
  bool outside_ = false;
  std::vector<HalfSpace> sides_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), axis_ = Eigen::Vector3d::UnitZ();
  double lo_ = 0.0, hi_ = 0.0, radius_lo_ = 0.0, radius_hi_ = 0.0;
  std::vector<Solid> members_;

  double radius_at(double distance) const;
  std::pair<double, double> convex_part(const Eigen::Vector3d &from, const Eigen::Vector3d &to) const;
  bool volume_of_common(const Polyhedron &box, double &volume, std::string &why) const;
  bool volume_between(const std::vector<HalfSpace> &sides, double &volume, std::string &why) const;
};

}

#endif
