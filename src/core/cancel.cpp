#include "core/cancel.h"

#include "core/error.h"

namespace arris {

void CancelToken::check() const {
  if (requested()) throw Cancelled("interrupted");
}

}  // namespace arris
