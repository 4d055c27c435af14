# The device without program and parts, also for whoever compiles it into a board program.
set(F2812_SOURCES
  cpu/switches.c
  periph/clock.c
  wirelink/wirelink.c)
