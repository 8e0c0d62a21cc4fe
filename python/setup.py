"""A wheel of the package as it was built (cmake/tack_python.cmake)."""
import os

from setuptools import Distribution, setup


class Compiled(Distribution):
    def has_ext_modules(self):
        return True


setup(
    name="tack",
    version=os.environ["TACK_VERSION"],
    description="Adhesive contact of deformable solids by incremental potentials",
    python_requires=">=3.9",
    install_requires=["numpy"],
    extras_require={"hessians": ["scipy"]},
    packages=["tack"],
    package_data={"tack": ["*.so", "*.pyi", "lib/*", "lib/tack/*", "share/*"]},
    distclass=Compiled,
)
