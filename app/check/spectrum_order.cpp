// SPDX-License-Identifier: LGPL-3.0-or-later
// From eigenvalues that are known to be all there are to the claims about them.
#include "spectrum.hpp"

#include <algorithm>

namespace check {
namespace {

// Eigenvalues of the whole matrix: one number, one number in an interval, or some in a disc about 0.
struct Entry {
  const ListedValue* value;  // none: a disc
  int mode, multiplicity;
  mpq_class least, greatest;  // moduli are between these
  bool exact() const { return value != nullptr && value->lo == value->hi; }
};

std::vector<Entry> entries(const ListedRow& row) {
  std::vector<Entry> out;
  for (std::size_t m = 0; m < row.modes.size(); ++m) {
    const int copies = m == 0 || 2 * m == static_cast<std::size_t>(row.k) ? 1 : 2;
    for (const ListedValue& v : row.modes[m].values) {
      const auto same = std::find_if(out.begin(), out.end(), [&](const Entry& e) { return e.exact() && v.lo == v.hi && e.value->lo == v.lo; });
      if (same != out.end()) {
        same->multiplicity += copies * v.multiplicity;
        continue;
      }
      const mpq_class a = abs(v.lo), b = abs(v.hi);
      out.push_back({&v, static_cast<int>(m), copies * v.multiplicity, sgn(v.lo) * sgn(v.hi) < 0 ? mpq_class(0) : std::min(a, b), std::max(a, b)});
    }
    if (row.modes[m].rest > 0) out.push_back({nullptr, static_cast<int>(m), copies * row.modes[m].rest, 0, row.modes[m].radius});
  }
  return out;
}

Order failing(const std::string& reason) { return {Order::fails, reason, nullptr, 0}; }
Order open(const std::string& reason) { return {Order::unknown, reason, nullptr, 0}; }

// 1 belongs to the eigenvalues, once, and all others are smaller; takes it away.
Order leading_one(std::vector<Entry>& all) {
  int ones = 0;
  std::erase_if(all, [&](const Entry& e) {
    const bool one = e.exact() && e.value->lo == 1;
    if (one) ones = e.multiplicity;
    return one;
  });
  if (ones > 1) return failing("1 has multiplicity " + std::to_string(ones));
  for (const Entry& e : all) {
    if (e.least >= 1) return failing("another eigenvalue is not smaller than 1");
  }
  for (const Entry& e : all) {
    if (ones == 0 && (e.value == nullptr ? e.greatest >= 1 : e.value->lo <= 1 && e.value->hi >= 1)) return open("1 may be an eigenvalue, and is not listed");
  }
  if (ones == 0) return failing("1 is no eigenvalue");
  for (const Entry& e : all) {
    if (e.greatest >= 1) return open("an eigenvalue may not be smaller than 1");
  }
  return {Order::holds, {}, nullptr, 0};
}

}  // namespace

Order order_of(const ListedRow& row) {
  std::vector<Entry> all = entries(row);
  if (Order first = leading_one(all); first.outcome != Order::holds) return first;
  if (all.empty()) return failing("there is no second eigenvalue");
  const auto top = std::max_element(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.least < b.least; });
  if (top->value == nullptr) return open("only bounds are known of the second eigenvalue");
  bool equal = false;
  for (auto e = all.begin(); e != all.end(); ++e) {
    if (e == top || e->greatest < top->least) continue;
    if (!top->exact() || !e->exact() || e->greatest != top->least) return open("the second and the third eigenvalue are not told apart");
    equal = true;
  }
  if (equal) return failing("two eigenvalues have the second modulus");
  if (sgn(top->value->hi) <= 0) return failing("the second eigenvalue is not positive");
  if (sgn(top->value->lo) <= 0) return open("the sign of the second eigenvalue is not certain");
  if (top->multiplicity != 2) return failing("the second eigenvalue has multiplicity " + std::to_string(top->multiplicity));
  return {Order::holds, {}, top->value, top->mode};
}

namespace {

// What is wrong with each statement about a row; empty if nothing is.
struct RowFaults {
  std::string ordering, ordering_fails, ring, ring_fails;
};

// Whether constant data stays constant; schemes see to that.
bool sums_to_one(Scheme scheme, const ListedRow& row) {
  if (!row.mask) return true;
  const std::vector<mpq_class>& w = row.mask->weights;
  mpq_class sum = w[0];
  for (std::size_t i = 1; i < w.size(); ++i) sum += scheme == Scheme::doo_sabin ? w[i] : mpq_class(row.k * w[i]);
  return sum == 1;
}

RowFaults faults_of(Scheme scheme, const ListedRow& row, bool with_ring) {
  RowFaults out;
  out.ordering = out.ordering_fails = spectrum_fault(scheme, row);
  out.ring = out.ring_fails = "rests on the ordering";
  if (!out.ordering.empty()) return out;
  const Order order = order_of(row);
  out.ordering = order.reason;
  if (order.outcome != Order::fails) out.ordering_fails = order.outcome == Order::holds ? "the ordering holds" : "it may hold: " + order.reason;
  if (order.outcome != Order::holds) return out;
  const int m = order.second_mode;
  const std::string mode = "the second eigenvalue is of mode " + std::to_string(m);
  if (scheme == Scheme::blocks) {
    out.ring = out.ring_fails = "the rules elsewhere are not given";
    return out;
  }
  if (!sums_to_one(scheme, row)) {
    out.ring = out.ring_fails = "the weights of the mask do not add up to 1";
    return out;
  }
  out.ring_fails = m > 1 && 2 * m < row.k ? "" : mode;
  if (m != 1) out.ring = mode;
  else if (!row.ring) out.ring = "there is no proof of the ring";
  else if (with_ring) out.ring = ring_fault(scheme, row, *order.second);
  return out;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> spectrum_faults(const SpectrumFile& file) {
  std::vector<RowFaults> rows;
  for (std::size_t i = 0; i < file.rows.size(); ++i) {
    bool claimed = false, with_ring = false;
    for (const SpectrumClaim& c : file.claims) {
      claimed = claimed || c.row == i;
      with_ring = with_ring || (c.row == i && (c.statement == Statement::ring || c.statement == Statement::c1));
    }
    rows.push_back(claimed ? faults_of(file.scheme, file.rows[i], with_ring) : RowFaults{});
  }
  std::vector<std::pair<std::string, std::string>> out;
  for (const SpectrumClaim& c : file.claims) {
    if (c.statement == Statement::regular) {
      const bool masks = std::any_of(file.rows.begin(), file.rows.end(), [](const ListedRow& row) { return row.mask.has_value(); });
      out.emplace_back(c.text, masks ? "masks say nothing of regular regions" : regular_fault(file.scheme, *file.regular));
      continue;
    }
    const RowFaults& f = rows[c.row];
    const std::string& ring = c.statement == Statement::c1_fails || c.statement == Statement::ring_fails ? f.ring_fails : f.ring;
    const bool of_order = c.statement == Statement::ordering || c.statement == Statement::ordering_fails;
    const bool of_ring = c.statement == Statement::ring || c.statement == Statement::ring_fails;
    if (of_order) out.emplace_back(c.text, c.statement == Statement::ordering ? f.ordering : f.ordering_fails);
    else out.emplace_back(c.text, of_ring || f.ordering.empty() ? ring : f.ordering);
  }
  return out;
}

}  // namespace check
