"""`python -m libins` is the `ins` command."""

from libins.cli import main

raise SystemExit(main())
