"""A wheel of the package as it was built (cmake/tack_python.cmake)."""
import os
import pathlib

from setuptools import Distribution, setup

here = pathlib.Path(__file__).parent
data = [str(path.relative_to(here / "tack")) for folder in ("bin", "lib", "share") for path in sorted((here / "tack" / folder).rglob("*")) if path.is_file()]


class Compiled(Distribution):
    def has_ext_modules(self):
        return True


setup(
    name="tack",
    version=os.environ["TACK_VERSION"],
    description="Adhesive contact of deformable solids by incremental potentials",
    license="MIT; with the libraries that a wheel contains GPL-3.0-or-later",
    python_requires=">=3.9",
    install_requires=["numpy"],
    extras_require={"hessians": ["scipy"]},
    packages=["tack"],
    py_modules=["tack_program"],
    package_data={"tack": ["*.so", "*.pyi", "py.typed", *data]},
    entry_points={"console_scripts": ["tack = tack_program:main"]},
    distclass=Compiled,
)
