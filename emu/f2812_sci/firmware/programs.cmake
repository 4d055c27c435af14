# The firmware that comes with the board: for 32 bits as users build it, and as objects that tests run in their own process.
foreach(program loopback_fifo echo autobaud)
  add_f2812_firmware(NAME ${program} SOURCES ${CMAKE_CURRENT_LIST_DIR}/${program}/${program}.c)
  add_f2812_firmware(NAME ${program} SOURCES ${CMAKE_CURRENT_LIST_DIR}/${program}/${program}.c BITS 64 OBJECT)
endforeach()
