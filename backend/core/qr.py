"""Links as something a phone can read off a screen or a sheet."""

from __future__ import annotations

import segno


def qr_of(link: str) -> str:
    """A link as a QR code (ISO/IEC 18004) with its quiet zone: a `data:` address of an SVG."""
    return segno.make_qr(link).svg_data_uri(dark="#000", light="#fff", border=4)
