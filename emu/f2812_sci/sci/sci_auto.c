/// Autobaud: 'A' and 'a' are known by the lengths between their six edges, and give the baud. (TI SPRU051, "SCI Auto-Baud".)
///
/// In bits, start bit first, 'A' is 0 1 00000 1 0 1 and 'a' is 0 1 0000 11 0 1. Falls 1 and 3 lie eight bits apart: that is measured.
/// SPDX-License-Identifier: MIT
#include "sci_internal.h"

enum
{
    SPAN_BITS = 8,    ///< between the first and the last fall
    TOLERANCE_IN = 4, ///< a length may be off by one bit / TOLERANCE_IN
    BRR_MAX = 0xFFFF
};

bool sci_auto_listens(const sci_t* self)
{
    return self->autobaud.armed && sci_released(self) && !sci_is(self, SCIFFCT, SCIFFCT_ABD);
}

/// Whether the last edges have those lengths [bit].
static bool fits(const sci_auto_t* autobaud, const uint8_t lengths[SCI_AUTO - 1])
{
    const uint64_t span = autobaud->tick[SCI_AUTO - 2u] - autobaud->tick[0];
    for (unsigned i = 0; i + 1u < SCI_AUTO; i++)
    {
        const uint64_t is = SPAN_BITS * (autobaud->tick[i + 1u] - autobaud->tick[i]), want = lengths[i] * span;
        const uint64_t off = is > want ? is - want : want - is;
        if (TOLERANCE_IN * off > span)
        {
            return false;
        }
    }
    return true;
}

static void lock(sci_t* self, uint8_t octet, uint64_t brr)
{
    self->autobaud.armed = false;
    self->reg[SCIHBAUD] = (uint16_t)(brr >> 8);
    self->reg[SCILBAUD] = brr & 0xFFu;
    sci_divide(self);
    sci_rx_begin(self);
    self->rx.done.any = true;
    self->rx.done.idle = self->rx.done.framing_error = false;
    self->rx.done.frame = (UINT32_C(1) << (SPAN_BITS + 1u)) | (uint32_t)octet << 1;
    self->rx.done.at = self->rx.next + SCI_PER_BIT - 2u;
    sci_set(self, SCIFFCT, SCIFFCT_ABD, true);
    sci_tx_interrupt(self, false);
    self->env.interrupt(self->env.ctx, true);
}

void sci_auto_edge(sci_t* self)
{
    static const uint8_t upper[SCI_AUTO - 1] = {1, 1, 5, 1, 1}, lower[SCI_AUTO - 1] = {1, 1, 4, 2, 1};
    sci_auto_t* const autobaud = &self->autobaud;
    for (unsigned i = 0; i + 1u < SCI_AUTO; i++)
    {
        autobaud->tick[i] = autobaud->tick[i + 1u];
    }
    autobaud->tick[SCI_AUTO - 1u] = sci_tick(self);
    if (autobaud->edges < SCI_AUTO)
    {
        autobaud->edges++;
    }
    if (autobaud->edges < SCI_AUTO || !self->rx.level)
    {
        return;
    }
    const uint64_t sciclk = SPAN_BITS * SCI_PER_BIT, span = autobaud->tick[SCI_AUTO - 2u] - autobaud->tick[0];
    const uint64_t divider = (span + sciclk / 2u) / sciclk;
    if (divider < 2u || divider > BRR_MAX + 1u)
    {
        return;
    }
    if (fits(autobaud, upper))
    {
        lock(self, 'A', divider - 1u);
    }
    else if (fits(autobaud, lower))
    {
        lock(self, 'a', divider - 1u);
    }
}
