"""Scenes and overrides as the program takes them: YAML, of which JSON is a part."""
import json
import os


def _plain(value):
    """NumPy's numbers and arrays, paths and mappings as JSON has them."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "items"):
        return dict(value)
    raise TypeError(f"a scene cannot hold {type(value).__name__}: {value!r}")


def text_of(scene):
    return json.dumps(scene, indent=1, default=_plain, allow_nan=False, ensure_ascii=False)


def overrides_of(values):
    """{"time.step": "2 ms"} as ["time.step=2 ms"]."""
    def one(value):
        return value if isinstance(value, str) else json.dumps(value, default=_plain, allow_nan=False, ensure_ascii=False)
    return [f"{key}={one(value)}" for key, value in (values or {}).items()]


def opened(scene):
    """(path, text) of a file or a dictionary: one of them is all there is."""
    if isinstance(scene, (str, os.PathLike)):
        return os.fspath(scene), ""
    return "scene", text_of(scene)
