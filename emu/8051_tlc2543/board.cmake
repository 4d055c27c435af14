# The acquisition board: its parts, its wiring, and the firmware it runs.
target_sources(emu_8051 PRIVATE parts/tlc2543.c)
