// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace hexact {

/// Calls `work(begin, end)` for ranges that cover 0 … count − 1 once, of about `grain` numbers or more, on all threads
/// that the program allows. What `work` writes must not depend on where ranges begin. Its exceptions pass through.
void for_ranges(std::size_t count, std::size_t grain, const std::function<void(std::uint32_t, std::uint32_t)>& work);

}  // namespace hexact
