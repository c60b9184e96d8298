# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads .vtp and .pvd files by their published format, by code that shares nothing with what writes them."""
import base64
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from case import require

NUMPY = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4"}


def array(element):
    raw = base64.b64decode(element.text.strip(), validate=True)
    size = int.from_bytes(raw[:8], "little")
    require(len(raw) == 8 + size, f"array {element.get('Name')}: {len(raw) - 8} bytes, its header says {size}")
    values = np.frombuffer(raw[8:], NUMPY[element.get("type")])
    components = int(element.get("NumberOfComponents", 1))
    return values.reshape(-1, components) if components > 1 else values


class PolyData:
    """points, and by name point_data and cell_data; lines, polys, verts: lists of the points of each cell."""

    def __init__(self, path):
        root = ElementTree.parse(path).getroot()
        require(root.get("type") == "PolyData" and root.get("header_type") == "UInt64", f"{path}: {root.attrib}")
        data = root.find("PolyData")
        self.time = float(array(data.find("FieldData/DataArray"))[0])
        piece = data.find("Piece")
        self.points = array(piece.find("Points/DataArray")).reshape(-1, 3)
        require(int(piece.get("NumberOfPoints")) == len(self.points), f"{path}: number of points")
        self.active = piece.find("PointData").attrib
        self.point_data = self._data(piece.find("PointData"), len(self.points), path)
        cells = 0
        for section in ("Verts", "Lines", "Polys"):
            found = self._cells(piece.find(section))
            require(int(piece.get(f"NumberOf{section}")) == len(found), f"{path}: number of {section}")
            setattr(self, section.lower(), found)
            cells += len(found)
        self.cell_data = self._data(piece.find("CellData"), cells, path)

    @staticmethod
    def _data(section, rows, path):
        found = {element.get("Name"): array(element) for element in section}
        wrong = [name for name, values in found.items() if len(values) != rows]
        require(not wrong, f"{path}: {wrong} have not {rows} rows")
        return found

    @staticmethod
    def _cells(section):
        if section is None:
            return []
        parts = {element.get("Name"): array(element) for element in section}
        return np.split(parts["connectivity"], parts["offsets"])[:-1]


def collection(path):
    """The files that a .pvd names, read, by time."""
    root = ElementTree.parse(path).getroot()
    require(root.get("type") == "Collection", f"{path}: {root.attrib}")
    found = {float(one.get("timestep")): PolyData(Path(path).parent / one.get("file")) for one in root.iter("DataSet")}
    for time, data in found.items():
        require(data.time == time, f"{path}: {time} in the list, {data.time} in the file")
    return found
