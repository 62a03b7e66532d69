"""Run the plant node."""

import sys

from .node import main

sys.exit(main())
