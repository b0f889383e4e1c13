"""Which passwords are taken: NIST SP 800-63B, 3.1.1: length, no rules on composition, none of the
commonest.
"""

from __future__ import annotations

import unicodedata

LENGTH_MIN = 8
# Far beyond any phrase; protects the hash from a megabyte.
LENGTH_MAX = 256

# The commonest of eight characters and more in lists of passwords that were stolen.
COMMON_TEXT = """
password passw0rd password1 password12 password123 password1234 password! p@ssw0rd p@ssword
12345678 123456789 1234567890 12345678910 0123456789 87654321 987654321 0987654321 123123123
11223344 12341234 123454321 147258369 1234qwer qwer1234 1q2w3e4r 1q2w3e4r5t q1w2e3r4 1qaz2wsx
zaq12wsx zaq1zaq1 qazwsxedc qwertyui qwertyuiop qwerty123 qwerty1234 qwerty12 asdfghjk asdfghjkl
zxcvbnm1 asdf1234 abcd1234 abc12345 abcdefgh abcdefghi a1b2c3d4 aa123456 a12345678 a123456789
iloveyou iloveyou1 princess princess1 sunshine sunshine1 football football1 baseball baseball1
basketball superman superman1 batman123 spiderman starwars computer internet michelle jennifer
victoria trustno1 whatever welcome1 welcome123 letmein1 letmein123 changeme changeme1 dragon123
monkey123 master123 shadow123 charlie1 jordan23 liverpool chelsea1 arsenal1 barcelona manchester
admin123 admin1234 administrator adminadmin root1234 rootroot test1234 testtest guest123
default1 login123 secret123 samsung1 google123 facebook hello123 helloworld blink182 nirvana1
metallica pokemon1 pokemon123 minecraft mercedes corvette mustang1 maverick midnight butterfly
chocolate elephant cocacola snoopy123 woaini1314 woaini520 5201314520 a5201314 147852369
789456123 159753456 741852963 bicycle1 bicycles spindle1 spindle123 workshop workshop1
"""
COMMON = frozenset(COMMON_TEXT.split())


def normal(password: str) -> str:
    """One spelling of what looks the same, as 800-63B asks for: NFKC."""
    return unicodedata.normalize("NFKC", password)


def fault_of(password: str, name: str) -> tuple[str, str] | None:
    """Why a password is not taken, as a code and a sentence; None if it is. name: its person's."""
    said = normal(password)
    if len(said) < LENGTH_MIN:
        return "too_short", f"A password has at least {LENGTH_MIN} characters; a sentence is good."
    if len(said) > LENGTH_MAX:
        return "too_long", f"A password has at most {LENGTH_MAX} characters."
    if said.casefold() in COMMON or len(set(said)) == 1:
        return "too_common", "This is among the first passwords that anybody tries."
    if said.casefold() == normal(name).casefold():
        return "is_the_name", "A password must not be the name it belongs to."
    return None
