"""Any text in the fonts there are, as markup of a paragraph.

Latin, Greek and Cyrillic come in Source Sans, embedded as far as used. Chinese is named, not
embedded: STSong-Light is one of the fonts that PDF leaves to the reader (ISO 32000-1, 9.7.5.2),
and the characters themselves are in the file. What neither has stands as its code point.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from itertools import groupby
from xml.sax.saxutils import escape

from reportlab.pdfbase.cidfonts import UnicodeCIDFont
from reportlab.pdfbase.pdfmetrics import registerFont, registerFontFamily, stringWidth
from reportlab.pdfbase.ttfonts import TTFont

LATIN, LATIN_BOLD, CHINESE = "SourceSans", "SourceSans-Bold", "STSong-Light"
FILES = {LATIN: "SourceSansPro-Regular.ttf", LATIN_BOLD: "SourceSansPro-Semibold.ttf"}


@cache
def latin_letters() -> frozenset[int]:
    """The code points of the embedded font. Makes all fonts known, once."""
    registerFont(UnicodeCIDFont(CHINESE))
    folder = files("font_source_sans_pro") / "files"
    for name, file in FILES.items():
        with (folder / file).open("rb") as data:
            font = TTFont(name, data)
        registerFont(font)
    registerFontFamily(LATIN, normal=LATIN, bold=LATIN_BOLD, italic=LATIN, boldItalic=LATIN_BOLD)
    return frozenset(font.face.charToGlyph)


def runs(text: str, latin: str = LATIN) -> list[tuple[str, str]]:
    """A line of text as (font, letters) one after the other."""
    letters = [_letter(one, latin) for one in " ".join(text.split())]
    return [
        (font, "".join(letter for _, letter in run))
        for font, run in groupby(letters, key=lambda one: one[0])
    ]


def marked(text: str, latin: str = LATIN) -> str:
    """A line of text as a paragraph's markup: nothing in it is markup itself."""
    return "".join(f'<font name="{font}">{escape(run)}</font>' for font, run in runs(text, latin))


def width_of(text: str, size: float) -> float:
    """In points."""
    return float(sum(stringWidth(run, font, size) for font, run in runs(text)))


def _letter(one: str, latin: str) -> tuple[str, str]:
    if not one.isprintable():
        return latin, f"[U+{ord(one):04X}]"
    if ord(one) in latin_letters():
        return latin, one
    try:
        one.encode("gbk")
    except UnicodeEncodeError:
        return latin, f"[U+{ord(one):04X}]"
    return CHINESE, one
