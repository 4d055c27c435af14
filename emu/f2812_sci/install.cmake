# f2812-cc with all it needs, below one folder, and find_package(libins COMPONENTS f2812) with add_f2812_firmware().
include(GNUInstallDirs)
set(home ${CMAKE_INSTALL_DATADIR}/libins/f2812)
install(PROGRAMS f2812-cc DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES firmware/f2812.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/libins RENAME libins-f2812-targets.cmake)
install(DIRECTORY dsp281x DESTINATION ${home})
install(DIRECTORY shim/include DESTINATION ${home}/shim)
install(FILES shim/program.c shim/prelink.ld shim/shim.h DESTINATION ${home}/shim)
install(DIRECTORY include/emu_f2812 ${PROJECT_SOURCE_DIR}/emu/common/include/emu DESTINATION ${home}/include)
foreach(bits 32 64)
  install(FILES ${INS_F2812_RUNTIME}/${bits}/libf2812.a ${INS_F2812_RUNTIME}/${bits}/libdsp281x.a ${INS_F2812_RUNTIME}/${bits}/libinsf.a
          DESTINATION ${home}/lib/${bits})
endforeach()
