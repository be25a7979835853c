// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hexact {

/// One thing that is wrong with outside data: which rule, which element, which numbers.
struct Finding {
  std::string code;                   ///< name of the violated rule, e.g. "NotManifold"
  std::string message;                ///< what was found and what was expected
  std::string element;                ///< e.g. "facet 12", "edge 3-7", "vertex 4"; empty if none
  std::optional<std::uint64_t> line;  ///< 1-based line of the input text, if it is known
};

/// Base of all exceptions that hexact throws on purpose.
class Error : public std::runtime_error {
 public:
  Error(std::string code, const std::string& message)
      : std::runtime_error(message), code_(std::move(code)) {}
  /// Stable name of the kind of error, for programs.
  [[nodiscard]] const std::string& code() const noexcept { return code_; }

 private:
  std::string code_;
};

/// Data that can be read but does not meet a precondition. Holds every finding, not only the first.
class InvalidInput : public Error {
 public:
  explicit InvalidInput(std::vector<Finding> findings)
      : Error(findings.empty() ? std::string("InvalidInput") : findings.front().code,
              findings.empty() ? std::string("invalid input") : describe(findings)),
        findings_(std::move(findings)) {}
  InvalidInput(std::string code, std::string message, std::string element)
      : InvalidInput(std::vector<Finding>{
            Finding{std::move(code), std::move(message), std::move(element), std::nullopt}}) {}
  [[nodiscard]] const std::vector<Finding>& findings() const noexcept { return findings_; }

 private:
  static std::string describe(const std::vector<Finding>& findings) {
    const Finding& first = findings.front();
    std::string text = first.element.empty() ? first.message : first.element + ": " + first.message;
    if (findings.size() > 1) {
      text += " (and " + std::to_string(findings.size() - 1) + " more findings)";
    }
    return text;
  }
  std::vector<Finding> findings_;
};

/// Bytes that do not follow their format. `file` may be empty for memory buffers.
class ParseError : public Error {
 public:
  ParseError(const std::string& message, std::string file, std::optional<std::uint64_t> line,
             std::string element = {})
      : Error("ParseError", message), file_(std::move(file)), line_(line),
        element_(std::move(element)) {}
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] std::optional<std::uint64_t> line() const noexcept { return line_; }
  [[nodiscard]] const std::string& element() const noexcept { return element_; }

 private:
  std::string file_;
  std::optional<std::uint64_t> line_;
  std::string element_;
};

/// A computation that cannot be carried out, for example because a bound on bits was passed.
class NumericalFailure : public Error {
 public:
  explicit NumericalFailure(const std::string& message) : Error("NumericalFailure", message) {}
};

/// A bound on size, memory, bits or time that would be, or was, passed.
class ResourceLimit : public Error {
 public:
  explicit ResourceLimit(const std::string& message) : Error("ResourceLimit", message) {}
};

/// A file that cannot be opened, read or written.
class FileError : public Error {
 public:
  FileError(const std::string& message, std::string file)
      : Error("FileError", message), file_(std::move(file)) {}
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

 private:
  std::string file_;
};

/// Another program that is missing or failed.
class ExternalToolError : public Error {
 public:
  explicit ExternalToolError(const std::string& message) : Error("ExternalToolError", message) {}
};

/// A defect of hexact itself: a broken precondition, postcondition or invariant.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace hexact

#define HEXACT_CONTRACT_(kind, condition)                                                \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      throw ::hexact::ContractViolation(std::string(kind " failed: " #condition " at ") + \
                                        __FILE__ + ":" + std::to_string(__LINE__));      \
    }                                                                                    \
  } while (false)
#define HEXACT_EXPECTS(condition) HEXACT_CONTRACT_("precondition", condition)
#define HEXACT_ENSURES(condition) HEXACT_CONTRACT_("postcondition", condition)
#define HEXACT_INVARIANT(condition) HEXACT_CONTRACT_("invariant", condition)
