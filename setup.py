"""Builds the one C extension; everything else is in pyproject.toml."""

from setuptools import setup

setup(cffi_modules=["sim_device/firmware/python/build.py:ffibuilder"])
