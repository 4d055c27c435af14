# The acquisition board: its parts, its wiring, and the firmware it runs.
target_sources(emu_8051 PRIVATE board.c board_state.c parts/tlc2543.c)
if(INS_BUILD_FIRMWARE)
  include(firmware/firmware.cmake)
  add_acq_firmware(acq_default 20000 9600 6 1)
  add_acq_firmware(acq_s3_paper 80000 9600 6 0)
  add_acq_firmware(acq_80ms_seq 80000 9600 6 1)
  add_acq_firmware(acq_57600 10000 57600 6 1)
endif()
