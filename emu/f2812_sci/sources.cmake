# The device without program and parts, also for whoever compiles it into a board program.
set(F2812_SOURCES
  cpu/blocks.c
  cpu/bus.c
  cpu/device.c
  cpu/interrupts.c
  cpu/names.c
  cpu/pie.c
  cpu/registers.c
  cpu/switches.c
  periph/clock.c
  periph/gpio.c
  periph/sysctl.c
  periph/timers.c
  periph/watchdog.c
  periph/xint.c
  wirelink/wirelink.c)
