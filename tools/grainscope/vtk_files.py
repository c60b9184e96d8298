# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes files for ParaView: .vtp (points, lines and surfaces with data) and .pvd (which file belongs to which time).
The format: VTK File Formats, https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html; arrays are base64."""
import base64
from xml.sax.saxutils import quoteattr

import numpy as np

TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "i4": "Int32"}


def _array(name, values, attributes=""):
    values = np.ascontiguousarray(values)
    code = values.dtype.str[1:]
    data = values.astype("<" + code).tobytes()
    text = base64.b64encode(np.array([len(data)], dtype="<u8").tobytes() + data).decode()
    components = int(np.prod(values.shape[1:]))
    return (
        f'<DataArray type="{TYPES[code]}" Name={quoteattr(name)} NumberOfComponents="{components}"{attributes} '
        f'format="binary">{text}</DataArray>\n'
    )


def _data(section, arrays, active=""):
    return f"<{section}{active}>\n{''.join(_array(name, values) for name, values in arrays.items())}</{section}>\n"


def _cells(section, lengths, points):
    """Cells of `lengths` points each, which `points` lists one after the other."""
    offsets = np.cumsum(np.asarray(lengths, dtype=np.int64))
    arrays = {"connectivity": np.asarray(points, dtype=np.int64).ravel(), "offsets": offsets}
    return _data(section, arrays)


def write_polydata(path, time, points, cells, point_data=None, cell_data=None, active=""):
    """`cells`: by section (Verts, Lines, Polys) the number of points of each cell, and the points of all. `active`: of
    the data of points, those that filters take by themselves, as ' Tensors="name"'."""
    counts = "".join(
        f' NumberOf{section}="{len(cells[section][0]) if section in cells else 0}"'
        for section in ("Verts", "Lines", "Strips", "Polys")
    )
    with open(path, "w") as file:
        file.write(
            '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" '
            'header_type="UInt64">\n<PolyData>\n'
        )
        file.write("<FieldData>\n" + _array("TimeValue", [float(time)], ' NumberOfTuples="1"') + "</FieldData>\n")
        file.write(f'<Piece NumberOfPoints="{len(points)}"{counts}>\n')
        file.write(_data("PointData", point_data or {}, active))
        file.write(_data("CellData", cell_data or {}))
        file.write(_data("Points", {"Points": points}))
        for section, (lengths, members) in cells.items():
            file.write(_cells(section, lengths, members))
        file.write("</Piece>\n</PolyData>\n</VTKFile>\n")


def write_collection(path, entries):
    """`entries`: time, and file beside this one, of each step."""
    lines = "".join(f'<DataSet timestep="{time!r}" part="0" file={quoteattr(str(file))}/>\n' for time, file in entries)
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
        f"<Collection>\n{lines}</Collection>\n</VTKFile>\n"
    )
