/* f2812_tick(): shows f2812_shim_turn() the registers that a caller keeps, its return address, and above them its frame.
   SPDX-License-Identifier: MIT */
        .text
        .globl  f2812_tick
        .type   f2812_tick, @function
f2812_tick:
#ifdef __x86_64__
        push    %rbp
        push    %rbx
        push    %r12
        push    %r13
        push    %r14
        push    %r15
        mov     %rsp, %rdi
        sub     $8, %rsp
        call    f2812_shim_turn
        add     $8, %rsp
        pop     %r15
        pop     %r14
        pop     %r13
        pop     %r12
        pop     %rbx
        pop     %rbp
#else
        push    %ebp
        push    %ebx
        push    %esi
        push    %edi
        mov     %esp, %eax
        sub     $8, %esp
        push    %eax
        call    f2812_shim_turn
        add     $12, %esp
        pop     %edi
        pop     %esi
        pop     %ebx
        pop     %ebp
#endif
        ret
        .size   f2812_tick, . - f2812_tick
        .section .note.GNU-stack, "", @progbits
