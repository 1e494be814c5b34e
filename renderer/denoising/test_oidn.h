// Places of the fake library (test_fake_oidn.cpp), and variables of the environment for one test.
#pragma once

#include <cstdlib>
#include <string>

namespace photonproof::inline renderer_denoising::test {

inline const std::string fake_oidn = PHOTONPROOF_FAKE_OIDN "/whole";
inline const std::string partial_oidn = PHOTONPROOF_FAKE_OIDN "/partial";  ///< lacks oidnExecuteFilter

/// Sets a variable until the end of the scope.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

}  // namespace photonproof::inline renderer_denoising::test
