"""`python -m hypoid`."""

import sys

from hypoid.cli import main

sys.exit(main())
