// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge_keep_size.hpp"

#include "hexact/kernel/midedge_keep_size_impl.hpp"

namespace hexact {

template class SizeKeeper<double>;

}  // namespace hexact
