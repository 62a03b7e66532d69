"""Run the logger node."""

import sys

from .node import main

sys.exit(main())
