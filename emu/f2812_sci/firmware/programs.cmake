# The firmware that comes with the board: for 32 bits as users build it, and as objects that tests run in their own process.
add_custom_target(firmware_f2812)
foreach(program loopback_fifo echo autobaud modem)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/${program}/*.c)
  add_f2812_firmware(NAME ${program} SOURCES ${sources})
  add_f2812_firmware(NAME ${program} SOURCES ${sources} BITS 64 OBJECT)
  add_dependencies(firmware_f2812 firmware_${program})
endforeach()

set(thesis ${CMAKE_CURRENT_LIST_DIR}/thesis)
set(thesis_sources ${thesis}/main.c ${thesis}/sci_gimu.c ${thesis}/sci_pc.c ${thesis}/calibrate.c ${thesis}/navigate.c ${thesis}/report.c)
add_f2812_firmware(NAME thesis CORE SOURCES ${thesis_sources})
add_f2812_firmware(NAME thesis CORE SOURCES ${thesis_sources} BITS 64 OBJECT)
# As in the thesis's first experiments, without GPS: with nulls, and without.
add_f2812_firmware(NAME thesis_ins CORE SOURCES ${thesis_sources} DEFINES THESIS_FILTER=0 THESIS_LEVEL=0)
add_f2812_firmware(NAME thesis_raw CORE SOURCES ${thesis_sources} DEFINES THESIS_NULLS=NULL_NONE THESIS_FILTER=0 THESIS_LEVEL=0)
add_dependencies(firmware_f2812 firmware_thesis firmware_thesis_raw)
