"""A second, tiny make of unit: lines of text, eight settings, no clock, no trial, no serial number.

It stands for what real units of other makes lack, and shows that nothing outside
`backend/device/ebl` relies on what only our own units have.
"""
