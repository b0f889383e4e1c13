"""`python -m backend.api.openapi`: prints the OpenAPI description; starts and opens nothing."""

from __future__ import annotations

import json
import sys

from backend import __version__
from backend.api.app import ApiSettings, create_app


def main() -> None:
    """Writes the description to standard output, sorted as the application gives it."""
    description = create_app(ApiSettings(version=__version__)).openapi()
    json.dump(description, sys.stdout, indent=1, ensure_ascii=False)
    sys.stdout.write("\n")


if __name__ == "__main__":
    main()
