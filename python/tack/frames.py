"""Frames of a run: VTK unstructured grids (.vtu) as tack writes them, raw appended data compressed by zlib."""
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

_types = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "UInt64": "<u8", "Int32": "<i4", "UInt32": "<u4", "Int8": "<i1", "UInt8": "<u1"}
_corners = {1: "points", 3: "edges", 5: "triangles", 10: "tets"}


class Frame:
    """A frame: `time` [s], `x` (n, 3) [m], fields of vertices and cells by name, `cells` by kind with their indices among all cells.

    frame["velocity"] is the field of vertices of that name, or else the field of cells.
    """

    def __init__(self, path):
        self.path = path
        with open(path, "rb") as file:
            content = file.read()
        mark = content.index(b"<AppendedData")
        start = content.index(b"_", mark) + 1
        end = content.rindex(b"</AppendedData>")
        root = ElementTree.fromstring(content[:mark] + b'<AppendedData encoding="raw"/>' + content[end + len(b"</AppendedData>"):])
        if root.get("compressor") != "vtkZLibDataCompressor" or root.get("header_type") != "UInt64" or root.get("byte_order") != "LittleEndian":
            raise ValueError(f"{path}: no frame as tack writes them (64-bit headers, little endian, zlib)")
        data = memoryview(content)[start:end]

        def array(element):
            values = np.frombuffer(_inflated(data, int(element.get("offset"))), dtype=_types[element.get("type")])
            columns = int(element.get("NumberOfComponents", 1))
            return values.reshape(-1, columns) if columns > 1 else values

        def fields(section):
            found = root.find(f".//{section}")
            return {} if found is None else {a.get("Name"): array(a) for a in found.findall("DataArray")}

        self.time = float(fields("FieldData")["TimeValue"][0])
        self.x = array(root.find(".//Points/DataArray"))
        self.of_vertices = fields("PointData")
        self.of_cells = fields("CellData")
        grid = fields("Cells")
        self.cells = _by_kind(grid)

    def __getitem__(self, name):
        for fields in (self.of_vertices, self.of_cells):
            if name in fields:
                return fields[name]
        raise KeyError(f"no field '{name}'; there are {', '.join([*self.of_vertices, *self.of_cells])}")

    def __repr__(self):
        return f"<frame at {self.time:g} s: {len(self.x)} vertices>"


def _inflated(data, offset):
    count, size, last = np.frombuffer(data[offset:offset + 24], "<u8").tolist()
    sizes = np.frombuffer(data[offset + 24:offset + 24 + 8 * count], "<u8").tolist()
    at, parts = offset + 24 + 8 * count, []
    for compressed in sizes:
        parts.append(zlib.decompress(data[at:at + compressed]))
        at += compressed
    return b"".join(parts)


def _by_kind(grid):
    """{"tets": (cell numbers, (n, 4)), ...}"""
    types, ends, corners = grid["types"], grid["offsets"], grid["connectivity"]
    cells = {}
    for kind, name in _corners.items():
        numbers = np.flatnonzero(types == kind)
        if len(numbers) == 0:
            continue
        size = int(ends[numbers[0]] - (ends[numbers[0] - 1] if numbers[0] > 0 else 0))
        cells[name] = (numbers, corners[ends[numbers, None] - size + np.arange(size)[None, :]])
    return cells
