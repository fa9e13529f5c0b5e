#include "Input/ReactionFormulas.h"

#include "Base/Errors.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExprTkFunctionParser.h"
#include "vtkNew.h"

#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace gridfem
{
namespace
{

struct Formula
{
  std::string property; // for messages
  std::string text;
};

/// Keeps the cause from an error of the parser, which tells it between "ERR201 - " and
/// "Expression".
void KeepCause(vtkObject* /*parser*/, unsigned long /*event*/, void* kept, void* text)
{
  std::string cause = static_cast<const char*>(text);
  const std::size_t end = cause.find("\tExpression");
  cause.resize(end == std::string::npos ? cause.size() : end);
  const std::size_t dash = cause.rfind(" - ");
  cause.erase(0, dash == std::string::npos ? cause.size() : dash + 3);
  *static_cast<std::string*>(kept) = cause;
}

/// Whether a text has no assignments, comments, strings or statements, all of which the parser
/// takes.
bool IsExpression(const std::string& text)
{
  const char* const letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return text.find_first_not_of(std::string(letters) + ".,+-*/%^()<>=!&|? \t\r\n") ==
           std::string::npos &&
         text.find("/*") == std::string::npos && text.find("//") == std::string::npos;
}

bool IsBlank(const std::string& text)
{
  return text.find_first_not_of(" \t\r\n") == std::string::npos;
}

/// The formulas of one thread.
class ParsedFormulas
{
public:
  /// Throws InvalidInput for a formula that cannot be read.
  explicit ParsedFormulas(const std::vector<Formula>& formulas) : parsers_(formulas.size())
  {
    for (std::size_t s = 0; s < formulas.size(); ++s)
    {
      this->Read(formulas[s], parsers_[s]);
    }
  }

  void Compute(const double* u, double* rates)
  {
    const int species = static_cast<int>(parsers_.size());
    for (int s = 0; s < species; ++s)
    {
      for (int variable = 0; variable < species; ++variable)
      {
        parsers_[s]->SetScalarVariableValue(variable, u[variable]);
      }
      rates[s] = parsers_[s]->GetScalarResult();
    }
  }

private:
  void Read(const Formula& formula, vtkExprTkFunctionParser* parser) const
  {
    std::string cause;
    vtkNew<vtkCallbackCommand> keepCause;
    keepCause->SetCallback(&KeepCause);
    keepCause->SetClientData(&cause);
    const unsigned long observer = parser->AddObserver(vtkCommand::ErrorEvent, keepCause);
    parser->ReplaceInvalidValuesOn();
    parser->SetReplacementValue(std::numeric_limits<double>::quiet_NaN());
    const std::vector<std::string> names = { "u", "v" };
    for (std::size_t s = 0; s < parsers_.size(); ++s)
    {
      parser->SetScalarVariableValue(names[s], 0.5);
    }
    parser->SetFunction(formula.text.c_str());
    const bool isNumber = IsExpression(formula.text) && parser->IsScalarResult();
    parser->RemoveObserver(observer);
    if (!isNumber)
    {
      throw InvalidInput(formula.property + " '" + formula.text + "' cannot be read" +
                         (cause.empty() ? "." : ": " + cause + ".") + " It is a formula of " +
                         (parsers_.size() == 1 ? "u" : "u and v") + ", such as " +
                         (parsers_.size() == 1 ? "u*(1-u)." : "0.1 - u + u^2*v."));
    }
  }

  std::vector<vtkNew<vtkExprTkFunctionParser>> parsers_;
};

/// Formulas that several threads compute at the same time. A parser serves one thread at a time.
class SharedFormulas
{
public:
  explicit SharedFormulas(std::vector<Formula> formulas) : formulas_(std::move(formulas))
  {
    this->Return(this->Taken());
  }

  void Compute(const double* u, double* rates, Id places)
  {
    std::unique_ptr<ParsedFormulas> parsed = this->Taken();
    const Id species = static_cast<Id>(formulas_.size());
    for (Id place = 0; place < places; ++place)
    {
      parsed->Compute(u + species * place, rates + species * place);
    }
    this->Return(std::move(parsed));
  }

private:
  std::unique_ptr<ParsedFormulas> Taken()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!idle_.empty())
      {
        std::unique_ptr<ParsedFormulas> taken = std::move(idle_.back());
        idle_.pop_back();
        return taken;
      }
    }
    return std::make_unique<ParsedFormulas>(formulas_);
  }

  void Return(std::unique_ptr<ParsedFormulas> parsed)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(parsed));
  }

  std::vector<Formula> formulas_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<ParsedFormulas>> idle_;
};

} // namespace

GivenReactions ReactionsOfFormulas(const std::string& ofU, const std::string& ofV)
{
  if (IsBlank(ofU))
  {
    return {};
  }
  std::vector<Formula> formulas = { { "Reaction U", ofU } };
  if (!IsBlank(ofV))
  {
    formulas.push_back({ "Reaction V", ofV });
  }
  GivenReactions reactions;
  reactions.species = static_cast<int>(formulas.size());
  reactions.version.Add(ofU).Add(ofV);
  reactions.rates = [shared = std::make_shared<SharedFormulas>(std::move(formulas))](
                      const double* u, double* rates, Id places)
  { shared->Compute(u, rates, places); };
  return reactions;
}

} // namespace gridfem
