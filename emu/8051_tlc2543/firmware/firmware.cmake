# add_acq_firmware(NAME PERIOD_US BAUD BLOCK_LEN SEQ [CHANNELS]): one image of acq.c, as ${CMAKE_BINARY_DIR}/firmware/NAME.ihx with its .map, .mem and
# listings (NAME.MODULE.rst), and NAME_debug.ihx with its .cdb: SDCC 4.2 makes other code with --debug (a return jumps to the one RET,
# a last call is no jump).
# Its options are described in acq_config.h, which refuses what cannot work. Timer 0 ticks about once a millisecond: of the whole
# numbers of ticks that divide the period, the one nearest 1024 machine cycles a tick is taken. CHANNELS is 3 unless given; six
# take 1152 cycles a tick for their longer scan, and leave 18 octets of RAM to a stack of 16.
find_program(INS_SDCC sdcc)
if(NOT INS_SDCC)
  message(FATAL_ERROR "SDCC, which builds the 8051 firmware, is missing. Install it: sudo apt-get install --no-install-recommends sdcc "
                      "(or configure with -DINS_BUILD_FIRMWARE=OFF)")
endif()

add_custom_target(firmware_8051 ALL)

function(add_acq_firmware name period_us baud block_len seq)
  set(here ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  set(core ${PROJECT_SOURCE_DIR}/libins/core)
  math(EXPR rest "${period_us} * 576 % 625")
  if(NOT rest EQUAL 0)
    message(FATAL_ERROR "add_acq_firmware(${name}): a period of ${period_us} us is not a whole number of machine cycles at 11.0592 MHz; "
                        "take a multiple of 625/576 us (any multiple of 625 us is one)")
  endif()
  math(EXPR cycles "${period_us} * 576 / 625")
  set(channels 3)
  if(ARGC GREATER 5)
    set(channels ${ARGV5})
  endif()
  set(target 1024)
  set(stack 20)
  if(channels EQUAL 6)
    set(target 1152)
    set(stack 18)
  endif()
  set(best 1000000000)
  foreach(ticks RANGE 1 255)
    math(EXPR rest "${cycles} % ${ticks}")
    math(EXPR tick "${cycles} / ${ticks}")
    math(EXPR off "${tick} - ${target}")
    if(off LESS 0)
      math(EXPR off "-4 * ${off}")
    endif()
    if(rest EQUAL 0 AND off LESS best)
      set(best ${off})
      set(best_ticks ${ticks})
      set(best_tick ${tick})
    endif()
  endforeach()
  # Longest wait for the host: two fifths of a period, so that one lost answer still leaves time for an exchange; at least 5 octets.
  math(EXPR reply_us "${period_us} * 2 / 5")
  math(EXPR octets_us "5 * 10 * 1000000 / ${baud}")
  if(reply_us LESS octets_us)
    set(reply_us ${octets_us})
  endif()
  math(EXPR reply_ticks "(${reply_us} * 576 / 625 + ${best_tick} - 1) / ${best_tick}")

  set(flags -mmcs51 --model-small --std-c11 --Werror -I${core}/include -DINS_REAL_FLOAT -DINS_HS_MEM=__idata
            -DINS_HS_BLOCK_MAX=${block_len} -DACQ_PERIOD_US=${period_us} -DACQ_TICKS=${best_ticks} -DACQ_TICK_CYCLES=${best_tick}
            -DACQ_BAUD=${baud} -DACQ_CHANNELS=${channels} -DACQ_BLOCK_LEN=${block_len} -DACQ_SEQ=${seq}
            -DACQ_REPLY_TICKS=${reply_ticks} -DACQ_RETRIES=3)
  set(out ${CMAKE_BINARY_DIR}/firmware)
  foreach(image ${name} ${name}_debug)
    set(work ${CMAKE_CURRENT_BINARY_DIR}/firmware/${image})
    file(MAKE_DIRECTORY ${work} ${out})
    set(debug "")
    set(products ${work}/${image}.ihx ${work}/${image}.map ${work}/${image}.mem)
    if(image MATCHES "_debug$")
      set(debug --debug)
      list(APPEND products ${work}/${image}.cdb)
    endif()
    list(TRANSFORM products REPLACE "^${work}" "${out}" OUTPUT_VARIABLE copies)
    set(listings ${out}/${image}.acq.rst ${out}/${image}.handshake_board.rst)
    add_custom_command(
      OUTPUT ${copies} ${listings}
      COMMAND ${INS_SDCC} ${flags} ${debug} -c ${here}/acq.c -o ${work}/acq.rel
      COMMAND ${INS_SDCC} ${flags} ${debug} -c ${core}/src/handshake_board.c -o ${work}/handshake_board.rel
      COMMAND ${INS_SDCC} -mmcs51 --model-small ${debug} --iram-size 128 --code-size 4096 --stack-size ${stack} ${work}/acq.rel
              ${work}/handshake_board.rel -o ${work}/${image}.ihx
      COMMAND ${CMAKE_COMMAND} -E copy ${products} ${out}
      COMMAND ${CMAKE_COMMAND} -E copy ${work}/acq.rst ${out}/${image}.acq.rst
      COMMAND ${CMAKE_COMMAND} -E copy ${work}/handshake_board.rst ${out}/${image}.handshake_board.rst
      DEPENDS ${here}/acq.c ${here}/acq_config.h ${core}/src/handshake_board.c
              ${core}/include/ins/handshake.h ${core}/include/ins/config.h
      COMMENT "SDCC ${image}.ihx: ${best_ticks} ticks of ${best_tick} cycles, ${baud} Bd, reply within ${reply_ticks} ticks"
      VERBATIM)
  endforeach()
  add_custom_target(firmware_${name} DEPENDS ${out}/${name}.ihx ${out}/${name}_debug.ihx)
  add_dependencies(firmware_8051 firmware_${name})
endfunction()
