// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/spectrum.hpp"

#include "command.hpp"
#include "hexact/exact/spectrum_certificate.hpp"
#include "hexact/exact/spectrum_masks.hpp"
#include "hexact/io/masks_file.hpp"
#include "hexact/io/output_file.hpp"
#include "hexact/io/spectrum_certificate_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "regular_report.hpp"
#include "spectrum_matrix.hpp"
#include "spectrum_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>

namespace hexact::app {
namespace {

struct SpectrumOptions {
  std::string scheme, masks, valence, certificate, matrix, picture;
  bool regular = false;
};

constexpr int kDigits = 32;  // enclosures of width 2^-104 stay narrower than 2^-100
constexpr int kLargestValence = 1000;

struct Range {
  int first = 0, last = 0;
};

/// "K" or "A..B".
Range valence_range(const std::string& text) {
  const auto number = [&](std::string_view word) {
    int n = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
    if (error != std::errc() || end != word.data() + word.size() || n < 3 || n > kLargestValence) {
      throw UsageError(fmt::format("--valence takes K or A..B with numbers from 3 to {}, not {}", kLargestValence, text));
    }
    return n;
  };
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) return {number(text), number(text)};
  const Range range{number(std::string_view(text).substr(0, dots)), number(std::string_view(text).substr(dots + 2))};
  if (range.last < range.first) throw UsageError("--valence A..B needs A <= B, not " + text);
  return range;
}

SpectrumScheme scheme_of(const std::string& name) {
  for (const SpectrumScheme s : {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop,
                                 SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
    if (name == name_of(s)) return s;
  }
  throw UsageError("there is no spectrum of the scheme " + name);
}

nlohmann::ordered_json enclosure_json(const RationalInterval& interval) {
  const DecimalEnclosure d = decimal_enclosure(interval, kDigits);
  return nlohmann::ordered_json::array({d.lo, d.hi});
}

struct Listed {
  int mode;
  const Eigenvalue* value;
};

/// Every eigenvalue as often as it occurs in the whole matrix, in decreasing order.
std::vector<Listed> listed(const SpectrumRow& row) {
  std::vector<Listed> out;
  for (const ModeSpectrum& m : row.modes) {
    for (const Eigenvalue& e : m.isolated) {
      for (int i = 0; i < e.multiplicity; ++i) {
        out.push_back({e.mode, &e});
        if (e.mode != 0 && 2 * e.mode != row.valence) out.push_back({row.valence - e.mode, &e});
      }
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Listed& a, const Listed& b) { return a.value->enclosure.lo > b.value->enclosure.lo; });
  return out;
}

nlohmann::ordered_json row_json(const SpectrumRow& row) {
  nlohmann::ordered_json json, values = nlohmann::ordered_json::array(), modes = nlohmann::ordered_json::array();
  for (const Listed& e : listed(row)) {
    values.push_back(enclosure_json(e.value->enclosure));
    modes.push_back(e.mode);
  }
  int remaining = 0;
  for (const ModeSpectrum& m : row.modes) remaining += m.remaining;
  json["k"] = row.valence;
  json["eigenvalues"] = std::move(values);
  json["modes"] = std::move(modes);
  json["not_isolated"] = remaining;
  json["lambda"] = row.subdominant ? enclosure_json(row.subdominant->enclosure) : nlohmann::ordered_json();
  json["next"] = row.next ? enclosure_json(row.next->enclosure) : nlohmann::ordered_json();
  json["next_mode"] = row.next ? nlohmann::ordered_json(row.next->mode) : nlohmann::ordered_json();
  json["ordering"] = name_of(row.ordering);
  json["ring"] = name_of(row.ring.verdict);
  json["c1"] = name_of(row.c1);
  json["level"] = row.ring.level;
  json["jacobian"] = decimal_enclosure({row.ring.jacobian, row.ring.jacobian}, 6).lo;
  json["half_plane"] = decimal_enclosure({row.ring.half_plane, row.ring.half_plane}, 6).lo;
  if (row.ordering != Verdict::proved) json["witness"] = row.ordering_witness;
  else if (row.ring.verdict != Verdict::proved) json["witness"] = row.ring.reason;
  return json;
}

std::string rounded_text(const std::optional<Eigenvalue>& e) {
  return e ? fmt::format("{:.15f}", e->enclosure.lo.to_double()) : "-";
}

std::string row_text(const SpectrumRow& row) {
  std::string text = fmt::format("{:>4}  {:<17}  {:<17} {:>4}  {:<9}  {:<9}  {:<9}", row.valence, rounded_text(row.subdominant),
                                 rounded_text(row.next), row.next ? std::to_string(row.next->mode) : "-", name_of(row.ordering),
                                 name_of(row.ring.verdict), name_of(row.c1));
  if (row.ordering != Verdict::proved) text += "  " + row.ordering_witness;
  else if (row.ring.verdict != Verdict::proved) text += "  " + row.ring.reason;
  return text + "\n";
}

/// What the table is about: a scheme of the program, or a document of masks.
struct Request {
  std::string name;
  std::optional<SpectrumScheme> scheme;  ///< none for masks
  std::optional<MasksDocument> masks;
  std::vector<SpectrumSubject> subjects;
};

Request scheme_request(const SpectrumOptions& options) {
  if (options.valence.empty() && !options.regular) throw UsageError("--valence is missing: K or A..B; or --regular");
  Request request{options.scheme.empty() ? "midedge6" : options.scheme, {}, {}, {}};
  request.scheme = scheme_of(request.name);
  if (options.valence.empty()) {
    if (!options.matrix.empty()) throw UsageError("--valence is missing: --matrix writes those of a valence");
    return request;
  }
  const Range range = valence_range(options.valence);
  for (int k = range.first; k <= range.last; ++k) request.subjects.push_back(scheme_subject(*request.scheme, k));
  return request;
}

Request masks_request(const SpectrumOptions& options) {
  if (!options.scheme.empty()) throw UsageError("--masks names its own scheme");
  if (options.regular) throw UsageError("--regular is about a scheme: masks say nothing of regular regions");
  const Range range = options.valence.empty() ? Range{3, kLargestValence} : valence_range(options.valence);
  Request request;
  request.masks = io::read_masks(options.masks);
  request.name = request.masks->name;
  for (const ExtraordinaryMask& mask : request.masks->masks) {
    if (mask.valence >= range.first && mask.valence <= range.last) request.subjects.push_back(mask_subject(*request.masks, mask));
  }
  if (request.subjects.empty()) throw InvalidInput("NoMask", options.masks + " has no mask of these valences", "valence " + options.valence);
  return request;
}

SpectrumCertificate certificate_of(const Request& request, const std::vector<SpectrumRow>& rows, const SpectrumOptions& options) {
  std::string command = request.scheme ? "spectrum --scheme " + request.name : "spectrum --masks " + options.masks;
  if (!options.valence.empty()) command += " --valence " + options.valence;
  if (options.regular) command += " --regular";
  std::vector<std::string> provenance{"hexact " HEXACT_VERSION, std::move(command)};
  return request.scheme ? make_spectrum_certificate(*request.scheme, rows, std::move(provenance))
                        : make_spectrum_certificate(*request.masks, rows, std::move(provenance));
}

/// " ordering=3..50 ring=3..50,52": claims by kind, neighbouring valences together.
std::string claims_text(const std::vector<SpectrumClaim>& claims) {
  std::map<SpectrumClaimKind, std::vector<int>> valences;
  for (const SpectrumClaim& claim : claims) valences[claim.kind].push_back(claim.valence);
  std::string text;
  for (auto& [kind, list] : valences) {
    std::sort(list.begin(), list.end());
    text += " " + text_of({kind, list.front()});
    for (std::size_t i = 0, end = 0; i < list.size(); i = end) {
      for (end = i + 1; end < list.size() && list[end] == list[end - 1] + 1; ++end) {}
      if (i > 0) text += "," + std::to_string(list[i]);
      if (end - i > 1) text += (end - i > 2 ? ".." : ",") + std::to_string(list[end - 1]);
    }
  }
  return text;
}

nlohmann::ordered_json claims_json(const std::vector<SpectrumClaim>& claims) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SpectrumClaim& claim : claims) json.push_back(text_of(claim));
  return json;
}

/// Writes the certificate, unless it would state nothing, and reports what it states and what it leaves out.
void write_certificate(Outcome& outcome, const Request& request, const std::vector<SpectrumRow>& rows,
                       const std::optional<RegularSmoothness>& regular, const SpectrumOptions& options) {
  SpectrumCertificate certificate = certificate_of(request, rows, options);
  std::vector<SpectrumClaim> omitted;
  for (const SpectrumRow& row : rows) {
    for (const SpectrumClaim& claim : proved_claims(row)) {
      if (std::find(certificate.claims.begin(), certificate.claims.end(), claim) == certificate.claims.end()) omitted.push_back(claim);
    }
  }
  if (regular) {
    certificate.claims.push_back({SpectrumClaimKind::regular, 0});
    certificate.regular = regular->evidence;
  }
  const bool written = !certificate.claims.empty();
  if (written) io::write_file(options.certificate, io::spectrum_certificate_text(certificate));
  outcome.report["certificate"] = written ? nlohmann::ordered_json(options.certificate) : nlohmann::ordered_json();
  outcome.report["claims"] = claims_json(certificate.claims);
  outcome.report["left_out"] = claims_json(omitted);
  if (options.certificate == "-") {
    outcome.text.clear();
    return;
  }
  outcome.text += written ? "certificate: " + options.certificate + "\nstates" + claims_text(certificate.claims) + "\n" : "no certificate: it would state nothing\n";
  if (!omitted.empty()) outcome.text += "leaves out" + claims_text(omitted) + "\n";
}

Outcome spectrum(const SpectrumOptions& options, const Common& common) {
  if (options.certificate == "-" && common.json) throw UsageError("--json and the certificate cannot both go to standard output");
  if (options.matrix == "-" && (common.json || options.certificate == "-")) throw UsageError("only one document can go to standard output");
  const Request request = options.masks.empty() ? scheme_request(options) : masks_request(options);
  const std::vector<SpectrumSubject>& subjects = request.subjects;
  if (!options.picture.empty() && subjects.size() != 1) throw UsageError("--picture shows one valence");
  const std::vector<SpectrumRow> rows = spectrum_rows(subjects, common.work.part(0, 0.9));
  Outcome outcome;
  Verdict all = Verdict::proved;
  nlohmann::ordered_json table = nlohmann::ordered_json::array();
  outcome.text = request.name + "\n";
  if (!rows.empty()) outcome.text += fmt::format("{:>4}  {:<17}  {:<17} {:>4}  {:<9}  {:<9}  {:<9}\n", "k", "lambda", "next", "mode", "ordering", "ring", "C1");
  for (const SpectrumRow& row : rows) {
    table.push_back(row_json(row));
    outcome.text += row_text(row);
    const Verdict v = overall(row);
    if (v == Verdict::refuted || all == Verdict::proved) all = v;
  }
  outcome.report["scheme"] = request.name;
  outcome.report["verdict"] = name_of(all);
  outcome.report["rows"] = std::move(table);
  std::optional<RegularSmoothness> regular;
  if (options.regular) {
    common.work.check();
    regular = regular_smoothness(*request.scheme);
    outcome.report["regular"] = regular_json(*regular);
    outcome.text += regular_text(*regular);
  }
  common.work.report(0.9);
  if (!options.matrix.empty()) write_subdivision_matrices(options.matrix, request.name, subjects);
  if (!options.picture.empty()) write_ring_picture(options.picture, subjects.front(), rows.front());
  if (!options.certificate.empty()) write_certificate(outcome, request, rows, regular, options);
  if (options.matrix == "-") outcome.text.clear();
  outcome.exit_code = all == Verdict::proved ? kDone : all == Verdict::refuted ? kClaimFails : kUndecided;
  return outcome;
}

}  // namespace

void add_spectrum(const Registry& registry) {
  const auto options = std::make_shared<SpectrumOptions>();
  CLI::App* command = registry.add("spectrum", "Eigenvalues and characteristic ring of a subdivision scheme, with the proof that it is C1");
  command->add_option("--scheme", options->scheme, "midedge, midedge6, loop, catmull-clark or doo-sabin (default: midedge6)");
  command->add_option("--valence", options->valence, "Valence K or range A..B; the face size for midedge, midedge6 and doo-sabin");
  command->add_flag("--regular", options->regular, "Smoothness where the mesh is regular: the class of the limit surface and its Hoelder exponent");
  command->add_option("--masks", options->masks, "JSON document of masks of your own, instead of a scheme");
  command->add_option("--certificate", options->certificate, "Certificate to write of what is proved, one way or the other; hexact-check verifies it");
  command->add_option("--matrix", options->matrix, "JSON to write: the exact matrices by blocks, and their characteristic polynomials");
  command->add_option("--picture", options->picture, "SVG drawing of the ring of the characteristic map, for one valence");
  Common& common = registry.common;
  command->callback([&selected = registry.selected, &common, options] {
    selected = [&common, options] { return spectrum(*options, common); };
  });
}

}  // namespace hexact::app
