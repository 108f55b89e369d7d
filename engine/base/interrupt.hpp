#pragma once

namespace argand {

/// Makes SIGINT (Ctrl-C) and SIGTERM set a flag instead of ending the program, so that long work
/// can stop at its next step and leave no half-written file. A second signal, more than half a
/// second later, ends the program at once with status 128 + signal.
void catch_interrupts();

/// Whether a signal has arrived.
bool interrupted();

/// Clears the flag.
void forget_interrupt();

} // namespace argand
