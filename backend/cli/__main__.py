"""`python -m backend.cli` is `spindle`."""

import sys

from backend.cli import main

sys.exit(main())
