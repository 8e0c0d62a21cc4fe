"""Compares what ParaView reads of a run with three of its frames, and the times of all. Arguments: the folder of the run, and the source tree."""
import importlib.util
import pathlib
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

run, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
specification = importlib.util.spec_from_file_location("frames", source / "python/tack/frames.py")
frames = importlib.util.module_from_spec(specification)
specification.loader.exec_module(frames)

chosen = (1, 4, 9)
expected = [frames.Frame(path) for path in sorted((run / "frames").glob("frame_*.vtu"))]
reader = simple.OpenDataFile(str(run / "run.pvd"))
assert reader is not None, "ParaView does not open run.pvd"
reader.UpdatePipelineInformation()
times = list(reader.TimestepValues)
assert times == [frame.time for frame in expected], f"times: {times}"
assert len(times) == 11 and abs(times[-1] - 0.1) < 1e-12, f"times: {times}"


def arrays(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def same(what, number, read, wanted):
    assert read.shape == wanted.shape, f"{what}: {read.shape}, expected {wanted.shape}"
    assert np.array_equal(read, wanted), f"{what}: off by {abs(read - wanted).max()} in frame {number}"


for number in chosen:
    reader.UpdatePipeline(times[number])
    grid = servermanager.Fetch(reader)
    frame = expected[number]
    same("positions", number, vtk_to_numpy(grid.GetPoints().GetData()), frame.x)
    points, cells = arrays(grid.GetPointData()), arrays(grid.GetCellData())
    same("velocity", number, points["velocity"], frame.of_vertices["velocity"])
    same("object", number, cells["object"], frame.of_cells["object"])
    assert set(points) == set(frame.of_vertices) and set(cells) == set(frame.of_cells), f"{set(points)}, {set(cells)}"
    assert np.ptp(frame.of_vertices["velocity"]) > 0 and len(np.unique(frame.of_cells["object"])) == 5, "the fields say little"
    for kind, (numbers, corners) in frame.cells.items():
        for i in (0, len(numbers) - 1):
            cell = grid.GetCell(int(numbers[i]))
            assert [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())] == list(np.ravel(corners[i])), f"{kind} {i} of frame {number}"
print(f"agrees: positions, velocity and object, {len(expected[0].x)} vertices, {len(times)} times, frames {chosen}, bit for bit")
