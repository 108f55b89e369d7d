#pragma once

namespace argand {

/// From now on SIGINT (Ctrl-C) and SIGTERM are noted instead of ending the program, so that long
/// work can stop at its next step and leave nothing half-written. A second one ends the program at
/// once, with status 128 + signal.
void catch_interrupts();

/// True once such a signal has come.
bool interrupted();

/// Forgets a signal that has come.
void forget_interrupt();

} // namespace argand
