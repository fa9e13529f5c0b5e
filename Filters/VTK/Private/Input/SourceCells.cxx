#include "Input/SourceCells.h"

#include "Pieces/PieceArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>

namespace gridfem
{
namespace
{

using CountsOfKinds = std::array<Id, CellKinds>;

/// Returns a number for each cell of this rank's piece. Collective.
std::vector<Id> NumberCells(const Communicator& ranks, vtkPolyData* piece, bool isCounted)
{
  std::vector<Id> number; // among those of the rank and the kind
  CountsOfKinds own{};
  CountsOfKinds ends{}; // of the piece's cells
  ranks.Together(
    [&]
    {
      if (!isCounted)
      {
        return;
      }
      auto* const ghosts = GhostsOf(piece->GetCellData(), piece->GetNumberOfCells());
      const auto kinds = CellsOf(piece);
      for (int kind = 0; kind < CellKinds; ++kind)
      {
        const Id count = kinds[kind] ? kinds[kind]->GetNumberOfCells() : 0;
        for (Id cell = 0; cell < count; ++cell)
        {
          const bool isCopied = ghosts && (ghosts->GetValue(static_cast<Id>(number.size())) &
                                            vtkDataSetAttributes::DUPLICATECELL) != 0;
          number.push_back(own[kind]);
          own[kind] += isCopied ? 0 : 1;
        }
        ends[kind] = static_cast<Id>(number.size());
      }
    });
  const std::vector<CountsOfKinds> all = ranks.Gather(std::vector<CountsOfKinds>{ own });
  Id before = 0;
  Id first = 0;
  for (int kind = 0; kind < CellKinds; ++kind)
  {
    for (int rank = 0; rank < ranks.Size(); ++rank)
    {
      if (rank == ranks.Rank())
      {
        std::for_each(
          number.begin() + first, number.begin() + ends[kind], [=](Id& cell) { cell += before; });
      }
      before += all[rank][kind];
    }
    first = ends[kind];
  }
  return number;
}

} // namespace

std::vector<Id> SourceCells(const Communicator& ranks, const Redistribution& distribution,
  vtkPolyData* piece, bool isCounted, const InputMesh& mesh)
{
  const std::vector<Id> number = NumberCells(ranks, piece, isCounted);
  MultiVector own;
  ranks.Together(
    [&]
    {
      own.resize(static_cast<Id>(mesh.sourceCell.size()), 1);
      std::transform(mesh.sourceCell.begin(), mesh.sourceCell.end(), own.data(),
        [&](Id cell) { return static_cast<double>(number[cell]); });
    });
  const MultiVector received = distribution.SendTriangles(own);
  return { received.data(), received.data() + received.size() };
}

} // namespace gridfem
