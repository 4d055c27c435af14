# The firmware that comes with the board: for 32 bits as users build it, and as objects that tests run in their own process.
foreach(program loopback_fifo echo autobaud)
  add_f2812_firmware(NAME ${program} SOURCES ${CMAKE_CURRENT_LIST_DIR}/${program}/${program}.c)
  add_f2812_firmware(NAME ${program} SOURCES ${CMAKE_CURRENT_LIST_DIR}/${program}/${program}.c BITS 64 OBJECT)
endforeach()

set(thesis ${CMAKE_CURRENT_LIST_DIR}/thesis)
set(thesis_sources ${thesis}/main.c ${thesis}/sci_gimu.c ${thesis}/sci_pc.c ${thesis}/calibrate.c ${thesis}/navigate.c ${thesis}/report.c)
add_f2812_firmware(NAME thesis CORE SOURCES ${thesis_sources})
add_f2812_firmware(NAME thesis CORE SOURCES ${thesis_sources} BITS 64 OBJECT)
