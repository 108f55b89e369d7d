#pragma once

#include <functional>

namespace argand {

/// Told the share of some work that is done; returns false to stop after the current batch.
using OnProgress = std::function<bool(double)>;

} // namespace argand
