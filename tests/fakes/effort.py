"""How much of a search the tests do: 1 in every run, ten times as much for a proof.

`SPINDLE_EFFORT=10 pytest ...` multiplies the counts of what is drawn at random.
"""

import os

EFFORT = int(os.environ.get("SPINDLE_EFFORT", "1"))
