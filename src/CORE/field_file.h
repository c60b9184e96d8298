// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_FILE_H
#define GRAINSCOPE_FIELD_FILE_H

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grainscope {

/** Quantities in the cells of a grid at one step, cell (ix, iy, iz) in row ix + nx (iy + ny iz). A row holds one value
 *  for each name, and behind them, where the table has errors, the error of each. */
struct FieldTable {
  std::array<int, 3> cells{{1, 1, 1}};
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();     // lowest along all three edges
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();  // of the whole grid, in columns
  std::vector<std::string> names;
  std::vector<double> values;  // row after row
  std::int64_t step = 0;
  double time = 0.0;

  std::size_t rows() const { return static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]; }
  /** Whether a row holds errors, by the number of values. */
  bool has_errors() const { return !names.empty() && values.size() == 2 * rows() * names.size(); }
  std::size_t columns() const { return has_errors() ? 2 * names.size() : names.size(); }
};

/** Whether the edges lie along x, y and z, within 1e-12 of the shortest. */
bool is_orthogonal(const FieldTable &table);

/** The texts of files. Numbers have 17 digits, which give back the same bits, and a point in every locale; what is not
 *  finite is nan, inf or -inf. A table whose cells, names and values do not fit together is refused by
 *  std::invalid_argument. */

/** Comma-separated: the lines `# step n`, `# time t`, `# cells nx ny nz`, a line of names, those of errors
 *  <name>_error, and a line for each row. */
std::string field_csv(const FieldTable &table);

/** VTK XML, cell data, with the time as TimeValue. Columns p_x p_y p_z are one vector p, the nine p_xx p_xy ... p_zz
 *  one tensor p row by row, and p_xx p_yy p_zz p_xy p_xz p_yz one symmetric tensor p in VTK's order xx yy zz xy yz xz;
 *  they stay apart where a column is called p, and where p has other such components too or lacks some. Errors are
 *  arrays <name>_error. All is ASCII; VTK 9.1 reads nan in it, older versions may not. */

/** An image (.vti), of orthogonal grids only; others are refused by std::invalid_argument. */
std::string field_vti(const FieldTable &table);

/** A structured grid (.vts), for tilted grids too; points have x fastest. */
std::string field_vts(const FieldTable &table);

}

#endif
