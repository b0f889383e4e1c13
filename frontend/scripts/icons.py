"""`.venv/bin/python frontend/scripts/icons.py` draws frontend/public/icons from spindle.svg.

Home screens take pictures, not drawings. They are committed: a browser draws them, which the build
does not need otherwise. Systems cut a maskable one to any shape within a circle of 80 % (W3C
manifest, section 5), iOS rounds the corners of its own: both are square and filled.
"""

from __future__ import annotations

import re
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.browser.chromium import find_chromium

PUBLIC = Path(__file__).resolve().parents[1] / "public"
DRAWING = (PUBLIC / "spindle.svg").read_text(encoding="utf-8")
# Name, width in pixels, and how large the sign is on a filled square; None as it is drawn.
ICONS = (
    ("192", 192, None),
    ("512", 512, None),
    ("maskable-512", 512, 0.85),
    ("apple-touch-icon", 180, 0.95),
)


def drawing(width_px: int, scale: float | None) -> str:
    """The drawing at this width; the sign scaled about its middle on a filled square."""
    sized = DRAWING.replace("<svg ", f'<svg width="{width_px}" height="{width_px}" ')
    if scale is None:
        return sized
    ground, sign = re.fullmatch(r"(<svg.*?<rect[^>]*/>)(.*)</svg>\s*", sized, re.S).groups()
    about = f"translate(16 16) scale({scale}) translate(-16 -16)"
    filled = re.sub(r' rx="\d+"', "", ground)
    return f'{filled}<g transform="{about}">{sign}</g></svg>'


with sync_playwright() as playwright:
    path = find_chromium(playwright.chromium.executable_path)
    browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
    page = browser.new_page()
    for name, width_px, scale in ICONS:
        page.set_viewport_size({"width": width_px, "height": width_px})
        page.set_content(f"<body style='margin:0'>{drawing(width_px, scale)}</body>")
        target = PUBLIC / "icons" / f"{name}.png"
        target.parent.mkdir(exist_ok=True)
        page.screenshot(path=target, omit_background=True)
    browser.close()
