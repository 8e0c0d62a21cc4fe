"""Results as tables of pandas and as labelled arrays of xarray, with units."""
from __future__ import annotations

import importlib
import json
import pathlib
from typing import Any, Sequence

import numpy as np

from . import _tack

# Columns of steps.csv by the beginning of their names (docs/results.md).
_step_units = {
    "s": ("time", "step_size", "wall_seconds", "seconds_", "load_time"),
    "J": ("energy_", "work_", "dissipated_", "path_work"),
    "m": ("min_distance", "min_gap", "penetration"),
    "N": ("unbalanced_force", "tolerated_force"),
}


def package(name: str) -> Any:
    """Returns a package that tack itself does without."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"{name} is not installed, or cannot be imported ({error}); Debian: apt install python3-{name}, elsewhere: pip install {name}") from error


def units_of(folder: pathlib.Path, table: str, columns: Sequence[str]) -> dict[str, str]:
    """Returns the SI units of the columns of a run's table, "1" of plain numbers; of tables other than probes and steps, of the time alone."""
    if table == "steps":
        return {column: next((unit for unit, names in _step_units.items() if column.startswith(names)), "1") for column in columns}
    known = {"time": "s", **(_tack.units(str(folder))["probes"] if table == "probes" else {})}
    return {column: known[column] for column in columns if column in known}


def units_of_batch(folder: pathlib.Path, table: dict) -> dict[str, str]:
    """Returns the SI units of the numbers in a batch's table, "1" of plain numbers."""
    known = batch_description(folder)["units"]
    return {name: known.get(name, "1") for name, column in table.items() if column.dtype.kind == "f"}


def batch_description(folder: pathlib.Path) -> dict:
    """Returns batch.json."""
    return json.loads((folder / "batch.json").read_text(encoding="utf-8"))


def pandas_table(columns: dict, units: dict[str, str], index: str | None = None) -> Any:
    """Returns a DataFrame, with `attrs["units"]`."""
    frame = package("pandas").DataFrame(dict(columns))
    frame.attrs["units"] = units
    return frame if index is None else frame.set_index(index)


def pandas_run(folder: pathlib.Path, name: str, table: dict) -> Any:
    """Returns the DataFrame of a table of a run, by time."""
    return pandas_table(table, units_of(folder, name, list(table)), "time" if "time" in table else None)


def _attributes(unit: str | None, text: str) -> dict[str, str]:
    """Returns the attributes of a variable; None: a text, which has no unit."""
    return {"long_name": text} if unit is None else {"units": unit or "1", "long_name": text}


def xarray_frames(folder: pathlib.Path, frames: Any, fields: Sequence[str] | None, every: int) -> Any:
    """Returns the frames of a run as a Dataset over time, vertex or element, and axis."""
    xarray = package("xarray")
    chosen = list(range(0, len(frames), every))
    if not chosen:
        raise ValueError(f"{folder}: the run has no frames; give output.frames")
    known = _tack.units(str(folder))["fields"]
    arrays: dict[str, list] = {"position": []}
    on: dict[str, str] = {"position": "vertex"}
    for i in chosen:
        frame = frames[i]
        arrays["position"].append(frame.x)
        for dimension, all_fields in (("vertex", frame.of_vertices), ("element", frame.of_cells)):
            for name, values in all_fields.items():
                if fields is None or name in fields:
                    arrays.setdefault(name, []).append(values)
                    on[name] = dimension
    missing = [name for name in fields or () if name not in arrays]
    if missing:
        raise ValueError(f"{folder}: frames have no field {', '.join(missing)}; there are {', '.join(list(frames[0].of_vertices) + list(frames[0].of_cells))}")
    variables = {}
    for name, values in arrays.items():
        if len({one.shape for one in values}) > 1 or len(values) != len(chosen):
            raise ValueError(f"{folder}: '{name}' changes its size from frame to frame, as with `remesh`; read its frames one by one")
        data = np.stack(values)
        component = [] if data.ndim == 2 else ["axis"] if data.shape[2] == 3 else [f"component_{data.shape[2]}"]
        unit, text = ("m", "position") if name == "position" else known.get(name, ("1", name))
        variables[name] = (["time", on[name], *component], data, _attributes(unit, text or name))
    return xarray.Dataset(variables, {"time": ("time", np.array(frames.times)[chosen], _attributes("s", "time")), "axis": ("axis", ["x", "y", "z"])}, {"name": folder.name})


def _axis(values: np.ndarray) -> np.ndarray:
    """Returns the different values in the order of their first appearance."""
    different, first = np.unique(values, return_index=True)
    return different[np.argsort(first)]


def xarray_batch(folder: pathlib.Path, table: dict) -> Any:
    """Returns the table of a batch as a Dataset over its parameters, or over its cases if these fill no grid."""
    xarray = package("xarray")
    description = batch_description(folder)
    parameters, units = [key for key in description["keys"] if key in table], units_of_batch(folder, table)
    axes = [_axis(table[name]) for name in parameters]
    shape = tuple(len(axis) for axis in axes)
    rows = len(table["case"])
    at = np.zeros(rows, dtype=int)
    for name, axis in zip(parameters, axes):
        position = {value: i for i, value in enumerate(axis.tolist())}
        at = at * len(axis) + np.array([position.get(value, 0) for value in table[name].tolist()], dtype=int)
    if parameters and int(np.prod(shape)) == rows and len(np.unique(at)) == rows:
        order = np.argsort(at)
        variables = {name: (parameters, column[order].reshape(shape), _attributes(units.get(name), name)) for name, column in table.items() if name not in parameters}
        places = {name: (name, axis, _attributes(units.get(name), name)) for name, axis in zip(parameters, axes)}
    else:
        variables = {name: (["case"], column, _attributes(units.get(name), name)) for name, column in table.items() if name not in ("case", *parameters)}
        places = {"case": ("case", table["case"], {"long_name": "case"}), **{name: ("case", table[name], _attributes(units.get(name), name)) for name in parameters}}
    return xarray.Dataset(variables, places, {"name": description["name"]})
