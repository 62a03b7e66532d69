"""Run the follower node."""

import sys

from .node import main

sys.exit(main())
