// SPDX-License-Identifier: LGPL-3.0-or-later
// hexact-check CERT [MESH]: verifies a certificate of a polyhedron with GMP alone. A second implementation: it shares
// no code with the library. Claims and their proofs are described in docs/certificates.md.
#include "certificate_text.hpp"
#include "corner_cut.hpp"
#include "embedded.hpp"
#include "rounded_mesh.hpp"
#include "spectrum.hpp"
#include "smooth_limit.hpp"
#include "surface.hpp"

#include <algorithm>
#include <cstdio>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace check {
namespace {

// One text for all positive multiples: the first coefficient of the normal that is not 0 becomes ±1.
std::string key(const Plane& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_zero(p[k])) continue;
    const Number pivot = sign(p[k]) < 0 ? Number(0) - p[k] : p[k];
    std::string out;
    for (const Number& x : p) out += text(quotient(x, pivot)) + " ";
    return out;
  }
  return {};
}

// Which of these half-spaces are facet half-spaces of the body. Looks first at the same place, where a corner cut
// keeps them, and through all planes only for the rest.
std::vector<bool> are_facets(const Body& body, const std::vector<Plane>& wanted) {
  const auto has_loop = [&](std::size_t f) { return body.surface.size(f) > 0; };
  std::vector<bool> found(wanted.size(), false);
  std::multimap<std::string, std::size_t> rest;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    found[i] = i < body.planes.size() && has_loop(i) && same_half_space(wanted[i], body.planes[i]);
    if (!found[i]) rest.emplace(key(wanted[i]), i);
  }
  for (std::size_t f = 0; f < body.planes.size() && !rest.empty(); ++f) {
    if (!has_loop(f)) continue;
    const auto [first, last] = rest.equal_range(key(body.planes[f]));
    for (auto it = first; it != last; ++it) found[it->second] = true;
    rest.erase(first, last);
  }
  return found;
}

// The half-space p holds on the convex body: it holds at v, and no edge leaves v outward of it.
std::string support_fault(const Body& body, const Edges& e, const Plane& p, std::size_t v) {
  const Planes& planes = body.planes;
  const auto& t = body.surface.triple[v];
  const Number height = det4(planes[t[0]], planes[t[1]], planes[t[2]], p);
  if (sign3(planes, t[0], t[1], t[2]) * sign(height) < 0) return vertex_name(v) + " is beyond it, det4 = " + text(height);
  Index h = e.leaving[v];
  do {
    const Number outward = det3(p, planes[e.facet[h]], planes[e.facet[e.twin[h]]]);
    if (sign(outward) > 0) return vertex_name(v) + " does not support it, det3 = " + text(outward);
    h = e.twin[e.previous[h]];
  } while (h != e.leaving[v]);
  return {};
}

// Decides the claims of one certificate. What several claims need is proved once; the replay of the levels runs
// beside the proof of the last one.
class Verifier {
 public:
  explicit Verifier(const Certificate& c) : c_(c) {
    for (const Claim& claim : c.claims) {
      if (claim.name != "corner-cut-of" || replays_.count(claim.reference) != 0) continue;
      replays_[claim.reference] = std::async(std::launch::async, [&c, name = claim.reference] {
        const Body& base = c.bodies.at(name);
        return base.root5 == c.body.root5 ? corner_cut_fault(c.body, base, name) : std::string();
      }).share();
    }
  }

  std::string fault(const Claim& claim) {
    const Body& body = c_.body;
    if (claim.name == "closed") return closed();
    if (claim.name == "planar") return convex().empty() ? "" : planar_fault(body.planes, body.surface);
    if (claim.name == "trivalent") return trivalent_fault(body.surface);
    if (claim.name == "embedded") return embedded_fault(body);
    if (!convex().empty() || claim.name == "convex") return convex();
    if (claim.name == "smooth-limit") return smooth_limit_gap(body);
    const Body& reference = c_.bodies.at(claim.reference);
    if (reference.root5 != body.root5) return "body " + claim.reference + " is over another field";
    Edges edges;
    if (std::string w = convex_fault(reference.planes, reference.surface, edges); !w.empty()) {
      return "body " + claim.reference + " is not convex: " + w;
    }
    return claim.name == "corner-cut-of" ? replays_.at(claim.reference).get() : inside(claim);
  }

 private:
  std::string closed() {
    if (convex().empty()) return {};
    Edges edges;
    return closed_fault(c_.body.surface, edges);
  }
  const std::string& convex() {
    if (!convex_) convex_ = convex_fault(c_.body.planes, c_.body.surface, edges_);
    return *convex_;
  }

  // `tangent` asks in addition that every facet half-space of the reference is one of the body.
  std::string inside(const Claim& claim) const {
    const Body& reference = c_.bodies.at(claim.reference);
    std::vector<Plane> half_spaces;
    for (std::size_t i = 0; i < reference.planes.size(); ++i) half_spaces.push_back(in_frame(reference, i, c_.body));
    const std::vector<bool> found = are_facets(c_.body, half_spaces);
    const auto supports = c_.supports.find(claim.reference);
    for (std::size_t i = 0; i < half_spaces.size(); ++i) {
      if (found[i]) continue;
      const std::string what = "half-space " + std::to_string(i) + " of " + claim.reference + ": ";
      if (claim.name == "tangent" && reference.surface.size(i) > 0) return what + "is no facet half-space";
      if (supports == c_.supports.end() || supports->second.count(i) == 0) return what + "no support is given";
      if (std::string w = support_fault(c_.body, edges_, half_spaces[i], supports->second.at(i)); !w.empty()) return what + w;
    }
    return {};
  }

  const Certificate& c_;
  Edges edges_;
  std::optional<std::string> convex_;
  std::map<std::string, std::shared_future<std::string>> replays_;
};

std::string quoted(const std::string& s) {
  std::string out = "\"";
  for (const char c : s) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) out += c;
  }
  return out + "\"";
}

// A certificate of spectra: its claims in the form of `run` below.
int run_spectrum(const std::string& path, bool json) {
  std::string claims, lines, witness;
  const SpectrumFile file = read_spectrum(path);
  for (const auto& [name, fault] : spectrum_faults(file)) {
    const char* const verdict = fault.empty() ? "proved" : "refuted";
    claims += (claims.empty() ? "" : ", ") + quoted(name) + ": " + quoted(verdict);
    lines += name + ": " + verdict + (fault.empty() ? "" : ": " + fault) + "\n";
    if (witness.empty() && !fault.empty()) witness = name + ": " + fault;
  }
  if (claims.empty()) throw Malformed(path, 0, "states no claims");
  const char* const verdict = witness.empty() ? "proved" : "refuted";
  const std::string tail = witness.empty() ? "" : ", \"witness\": " + quoted(witness);
  if (json) std::printf("{\"verdict\": %s, \"claims\": {%s}%s, %s}\n", quoted(verdict).c_str(), claims.c_str(), tail.c_str(), subject_json(file).c_str());
  else std::printf("%s%s%s\n", subject_text(file).c_str(), lines.c_str(), verdict);
  return std::fflush(stdout) != 0 ? 3 : witness.empty() ? 0 : 1;
}

int run(const std::vector<std::string>& files, bool json) {
  const Certificate c = read_certificate(files[0]);
  std::optional<Mesh> mesh;
  if (files.size() == 2) mesh = read_mesh(files[1]);
  std::string claims, lines, witness, gap;
  const auto add = [&](const std::string& name, const std::string& fault) {
    // What keeps the proof of smooth-limit from being complete does not refute it.
    const bool is_gap = !fault.empty() && name == "smooth-limit";
    const std::string verdict = fault.empty() ? "proved" : is_gap ? "undecided" : "refuted";
    claims += (claims.empty() ? "" : ", ") + quoted(name) + ": " + quoted(verdict);
    lines += name + ": " + verdict + (fault.empty() ? "" : ": " + fault) + "\n";
    std::string& first = is_gap ? gap : witness;
    if (first.empty() && !fault.empty()) first = name + ": " + fault;
  };
  Verifier verifier(c);
  for (const Claim& claim : c.claims) {
    add(claim.reference.empty() ? claim.name : claim.name + "=" + claim.reference, verifier.fault(claim));
  }
  if (mesh) add("mesh", rounding_fault(c.body, *mesh));
  const std::string verdict = !witness.empty() ? "refuted" : !gap.empty() ? "undecided" : "proved";
  if (json) {
    const std::string reason = witness.empty() ? gap : witness, tail = reason.empty() ? "" : ", \"witness\": " + quoted(reason);
    std::printf("{\"verdict\": %s, \"claims\": {%s}%s}\n", quoted(verdict).c_str(), claims.c_str(), tail.c_str());
  } else {
    std::printf("%s%s\n", lines.c_str(), verdict.c_str());
  }
  return std::fflush(stdout) != 0 ? 3 : !witness.empty() ? 1 : gap.empty() ? 0 : 5;
}

int report(const Malformed& e, bool json) {
  const std::string line = e.line == 0 ? "" : std::to_string(e.line);
  if (json) {
    std::printf("{\"error\": {\"code\": \"ParseError\", \"message\": %s, \"file\": %s, \"line\": %s, \"element\": null}}\n",
                quoted(e.what()).c_str(), quoted(e.file).c_str(), line.empty() ? "null" : line.c_str());
  }
  std::fprintf(stderr, "hexact-check: %s%s%s: %s\n", e.file.c_str(), line.empty() ? "" : ":", line.c_str(), e.what());
  return 3;
}

int report(const TooMuchWork& e, const std::string& file, bool json) {
  if (json) {
    std::printf("{\"error\": {\"code\": \"ResourceLimit\", \"message\": %s, \"file\": %s, \"line\": null, \"element\": null}}\n",
                quoted(e.what()).c_str(), quoted(file).c_str());
  }
  std::fprintf(stderr, "hexact-check: %s: %s\n", file.c_str(), e.what());
  return 4;
}

constexpr const char* kHelp =
    "hexact-check [--json] CERT [MESH]\n"
    "Verifies every claim of the certificate CERT with exact arithmetic and, given MESH (OBJ or OFF), that it is the\n"
    "correct rounding: the same loops, every coordinate the double nearest to the exact one (ties to even).\n"
    "Exit status: 0 all claims hold; 1 a claim does not hold (the witness is printed); 2 wrong usage;\n"
    "3 a file cannot be read or is malformed; 4 too much memory or work; 5 nothing is refuted and a claim is undecided.\n";

}  // namespace
}  // namespace check

int main(int argc, char** argv) {
  std::vector<std::string> files;
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--help" || a == "-h") return std::fputs(check::kHelp, stdout) < 0 ? 3 : 0;
    if (a == "--version") return std::printf("hexact-check 0.1.0\nGMP %s\n", gmp_version) < 0 ? 3 : 0;
    if (a == "--json") json = true;
    else if (a.size() > 1 && a[0] == '-') files.resize(3);
    else files.push_back(a);
  }
  if (files.empty() || files.size() > 2) return std::fputs(check::kHelp, stderr), 2;
  try {
    if (check::is_spectrum_file(files[0])) return files.size() == 1 ? check::run_spectrum(files[0], json) : 2;
    return check::run(files, json);
  } catch (const check::Malformed& e) {
    return check::report(e, json);
  } catch (const check::TooMuchWork& e) {
    return check::report(e, files[0], json);
  } catch (const std::bad_alloc&) {
    return std::fputs("hexact-check: there is not enough memory\n", stderr), 4;
  }
}
