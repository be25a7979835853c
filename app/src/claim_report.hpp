// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command.hpp"
#include "hexact/exact/certify.hpp"

#include <string>
#include <vector>

namespace hexact::app {

/// Exit status, JSON keys `verdict`, `claims`, `witness` and the text for people of decided claims.
inline Outcome claim_outcome(const std::vector<ClaimVerdict>& verdicts, const std::string& remark = {}) {
  Outcome out;
  const Verdict all = overall(verdicts);
  out.exit_code = all == Verdict::proved ? kDone : all == Verdict::refuted ? kClaimFails : kUndecided;
  out.report["verdict"] = name_of(all);
  nlohmann::ordered_json claims = nlohmann::ordered_json::object();
  for (const ClaimVerdict& v : verdicts) {
    claims[v.claim] = name_of(v.verdict);
    out.text += v.claim + ": " + name_of(v.verdict) + (v.witness.empty() ? "" : ": " + v.witness) + "\n";
    if (v.verdict == all && all != Verdict::proved && !out.report.contains("witness")) {
      out.report["witness"] = v.claim + ": " + v.witness + (remark.empty() ? "" : "; " + remark);
    }
  }
  out.report["claims"] = claims;
  out.text += std::string(name_of(all)) + (remark.empty() ? "" : " (" + remark + ")") + "\n";
  return out;
}

}  // namespace hexact::app
