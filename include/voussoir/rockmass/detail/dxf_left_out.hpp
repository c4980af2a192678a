// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/rockmass/detail/bounded_lines.hpp>
#include <voussoir/rockmass/detail/dxf_entity.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

/// The entities of a drawing that are not read: texts and points are counted, forms that may hold
/// lines of the section are refused.
class DxfLeftOut {
 public:
  VOUSSOIR_INLINE void add(const DxfEntity& entity, const std::string& layer);
  /// One that is left out for another reason than its type.
  void count(const std::string& reason) { ++counts_[reason]; }
  /// Says what was refused, each type once.
  VOUSSOIR_INLINE void finish(TraceFaults& faults) const;
  /// `begin` and "3 TEXT, 1 HATCH"; empty if nothing was left out.
  [[nodiscard]] VOUSSOIR_INLINE std::string text(const std::string& begin) const;

 private:
  struct Refused {
    std::string type, layer;
    const char *what, *remedy;
    std::size_t count, line;
  };
  std::map<std::string, std::size_t> counts_;
  std::vector<Refused> refused_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void DxfLeftOut::add(const DxfEntity& entity, const std::string& layer) {
  struct Kind {
    const char *type, *what, *remedy;
  };
  for (Refused& known : refused_)
    if (known.type == entity.type) {
      ++known.count;
      return;
    }
  for (const Kind& kind :
       {Kind{"SPLINE", "free curves",
             "lines, polylines and arcs: convert splines to polylines in the CAD program "
             "(SPLINEDIT, Convert to Polyline)"},
        Kind{"HELIX", "free curves",
             "lines, polylines and arcs: explode it in the CAD program (EXPLODE)"},
        Kind{"INSERT", "references to blocks",
             "lines, polylines and arcs: explode the blocks in the CAD program (EXPLODE), or ask "
             "for layers without them"},
        Kind{"MLINE", "multilines",
             "lines, polylines and arcs: explode them in the CAD program (EXPLODE)"}})
    if (entity.type == kind.type) {
      refused_.push_back({entity.type, layer, kind.what, kind.remedy, 1, entity.line});
      return;
    }
  count(entity.type);
}

VOUSSOIR_INLINE void DxfLeftOut::finish(TraceFaults& faults) const {
  for (const Refused& refused : refused_)
    faults.add(refused.line,
               message({refused.count, " ", refused.type, " (", refused.what,
                        ") cannot be read, the first on layer \"", shown(refused.layer), "\""}),
               refused.type, refused.remedy);
}

VOUSSOIR_INLINE std::string DxfLeftOut::text(const std::string& begin) const {
  constexpr std::size_t most = 20;
  std::string text;
  std::size_t types = 0;
  for (const auto& [what, number] : counts_)
    if (++types <= most)
      text += (text.empty() ? begin : std::string(", ")) + message({number, " ", shown(what)});
  return types > most ? message({text, " and ", types - most, " more types"}) : text;
}

#endif

}  // namespace voussoir::detail
