// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_file.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

namespace grainscope {

using Eigen::Vector3d;

namespace {

/** As printf's %.17g in the locale C; NaN without the sign that some processors give it. */
void append(std::string &text, double value) {
  if (std::isnan(value)) {
    text += "nan";
    return;
  }
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
  text.append(digits, end);
}

void append(std::string &text, const Vector3d &v) {
  for (int k = 0; k < 3; k++) {
    if (k > 0) text += ' ';
    append(text, v[k]);
  }
}

std::string dimensions(const FieldTable &table) {
  const auto &n = table.cells;
  return std::to_string(n[0]) + ' ' + std::to_string(n[1]) + ' ' + std::to_string(n[2]);
}

void require_whole(const FieldTable &table) {
  if (*std::min_element(table.cells.begin(), table.cells.end()) < 1)
    throw std::invalid_argument("a grid has at least one cell along each edge, got " + dimensions(table));
  const std::size_t row = table.names.size(), values = table.values.size();
  if (row == 0 || (values != table.rows() * row && values != 2 * table.rows() * row))
    throw std::invalid_argument(dimensions(table) + " cells with " + std::to_string(row) +
                                " names need one value for each, or two with errors, got " + std::to_string(values));
}

/** An array of a VTK file: its name and the columns of its components. */
struct Group {
  std::string name;
  std::vector<std::size_t> columns;
};

const std::vector<std::vector<std::string>> groups_of_components = {
    {"x", "y", "z"},
    {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"},
    {"xx", "yy", "zz", "xy", "yz", "xz"}};  // symmetric, in VTK's order

bool is_component(const std::string &word) {
  return !word.empty() && word.size() <= 2 && word.find_first_not_of("xyz") == std::string::npos;
}

/** Where a name ends in _ and a component: the place of the _; else npos. */
std::size_t component_mark(const std::string &name) {
  const std::size_t mark = name.rfind('_');
  const bool found = mark != std::string::npos && mark > 0 && is_component(name.substr(mark + 1));
  return found ? mark : std::string::npos;
}

/** The columns of all components of a prefix in the order of VTK; none where they are not a vector or a tensor. */
std::vector<std::size_t> columns_of_prefix(const std::vector<std::string> &names, const std::string &prefix) {
  std::set<std::string> found;
  for (const std::string &name : names) {
    if (name == prefix) return {};
    const std::size_t mark = component_mark(name);
    if (mark == prefix.size() && name.compare(0, mark, prefix) == 0) found.insert(name.substr(mark + 1));
  }
  for (const auto &components : groups_of_components) {
    if (found != std::set<std::string>(components.begin(), components.end())) continue;
    std::vector<std::size_t> columns;
    columns.reserve(components.size());
    for (const std::string &component : components)
      columns.push_back(std::find(names.begin(), names.end(), prefix + '_' + component) - names.begin());
    return columns;
  }
  return {};
}

/** All columns in groups, each group at the place of its first column. */
std::vector<Group> groups_of(const std::vector<std::string> &names) {
  std::vector<Group> groups;
  std::set<std::string> done;
  for (std::size_t k = 0; k < names.size(); k++) {
    const std::size_t mark = component_mark(names[k]);
    const std::string prefix = names[k].substr(0, mark == std::string::npos ? 0 : mark);
    const auto columns = prefix.empty() ? std::vector<std::size_t>() : columns_of_prefix(names, prefix);
    if (columns.empty()) groups.push_back({names[k], {k}});
    else if (done.insert(prefix).second) groups.push_back({prefix, columns});
  }
  return groups;
}

/** One array of the cells' data, `first` columns behind the values. */
void append_array(std::string &text, const FieldTable &table, const Group &group, std::size_t first,
                  const std::string &name) {
  text += "<DataArray type=\"Float64\" Name=\"" + name + "\" NumberOfComponents=\"" +
          std::to_string(group.columns.size()) + "\" format=\"ascii\">\n";
  for (std::size_t row = 0; row < table.rows(); row++)
    for (std::size_t column : group.columns) {
      append(text, table.values[row * table.columns() + first + column]);
      text += column == group.columns.back() ? '\n' : ' ';
    }
  text += "</DataArray>\n";
}

std::string cell_data(const FieldTable &table) {
  std::string text = "<CellData>\n";
  for (const Group &group : groups_of(table.names)) {
    append_array(text, table, group, 0, group.name);
    if (table.has_errors()) append_array(text, table, group, table.names.size(), group.name + "_error");
  }
  return text + "</CellData>\n";
}

std::string extent(const FieldTable &table) {
  const auto &n = table.cells;
  return "0 " + std::to_string(n[0]) + " 0 " + std::to_string(n[1]) + " 0 " + std::to_string(n[2]);
}

/** The file of one kind of grid, with the attributes of the whole and what stands in its piece beside the data. */
std::string vtk_file(const FieldTable &table, const std::string &kind, const std::string &attributes,
                     const std::string &points) {
  std::string time;
  append(time, table.time);
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind + "\" version=\"1.0\">\n<" + kind + " WholeExtent=\"" +
         extent(table) + '"' + attributes +
         ">\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">\n" +
         time + "\n</DataArray>\n</FieldData>\n<Piece Extent=\"" + extent(table) + "\">\n" + points + cell_data(table) +
         "</Piece>\n</" + kind + ">\n</VTKFile>\n";
}

}

bool is_orthogonal(const FieldTable &table) {
  const Eigen::Matrix3d aligned = table.edges.diagonal().asDiagonal();
  const double shortest = table.edges.diagonal().minCoeff();
  return shortest > 0.0 && (table.edges - aligned).cwiseAbs().maxCoeff() <= 1e-12 * shortest;
}

std::string field_csv(const FieldTable &table) {
  require_whole(table);
  std::string text = "# step " + std::to_string(table.step) + "\n# time ";
  append(text, table.time);
  text += "\n# cells " + dimensions(table) + '\n';
  std::string separator;
  for (const char *ending : {"", "_error"}) {
    for (const std::string &name : table.names) {
      text += separator + name + ending;
      separator = ",";
    }
    if (!table.has_errors()) break;
  }
  text += '\n';
  for (std::size_t k = 0; k < table.values.size(); k++) {
    append(text, table.values[k]);
    text += (k + 1) % table.columns() == 0 ? '\n' : ',';
  }
  return text;
}

std::string field_vti(const FieldTable &table) {
  require_whole(table);
  if (!is_orthogonal(table))
    throw std::invalid_argument("a vti file holds grids with edges along x, y and z; this one is tilted: use vts");
  const Vector3d cells(table.cells[0], table.cells[1], table.cells[2]);
  std::string attributes = " Origin=\"";
  append(attributes, table.corner);
  attributes += "\" Spacing=\"";
  append(attributes, table.edges.diagonal().cwiseQuotient(cells));
  return vtk_file(table, "ImageData", attributes + '"', "");
}

std::string field_vts(const FieldTable &table) {
  require_whole(table);
  const auto &n = table.cells;
  std::string points =
      "<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (int z = 0; z <= n[2]; z++)
    for (int y = 0; y <= n[1]; y++)
      for (int x = 0; x <= n[0]; x++) {
        const Vector3d share(double(x) / n[0], double(y) / n[1], double(z) / n[2]);
        append(points, table.corner + table.edges * share);
        points += '\n';
      }
  return vtk_file(table, "StructuredGrid", "", points + "</DataArray>\n</Points>\n");
}

}
