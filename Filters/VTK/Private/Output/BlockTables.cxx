#include "Output/BlockTables.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkTable.h"

#include <string>

namespace gridfem
{
namespace
{

/// The tables of the parts of a block. A part is a table or null.
struct NamedTables
{
  std::vector<vtkTable*> tables;
  std::string name;
};

NamedTables TablesOf(vtkPartitionedDataSet* parts, const char* name)
{
  NamedTables block;
  block.name = name ? name : "";
  for (unsigned int part = 0; parts && part < parts->GetNumberOfPartitions(); ++part)
  {
    if (auto* table = vtkTable::SafeDownCast(parts->GetPartitionAsDataObject(part)))
    {
      block.tables.push_back(table);
    }
  }
  return block;
}

std::vector<NamedTables> TablesOf(vtkDataObject* output)
{
  std::vector<NamedTables> blocks;
  if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(output))
  {
    for (unsigned int k = 0; k < collection->GetNumberOfPartitionedDataSets(); ++k)
    {
      const char* name = collection->HasMetaData(k)
                           ? collection->GetMetaData(k)->Get(vtkCompositeDataSet::NAME())
                           : nullptr;
      blocks.push_back(TablesOf(collection->GetPartitionedDataSet(k), name));
    }
  }
  else
  {
    blocks.push_back(TablesOf(vtkPartitionedDataSet::SafeDownCast(output), nullptr));
  }
  return blocks;
}

/// Returns a multi-block with one block for each table. Null if there is no table.
vtkSmartPointer<vtkDataObject> AsMultiBlock(vtkDataObject* output)
{
  vtkNew<vtkMultiBlockDataSet> made;
  for (const NamedTables& block : TablesOf(output))
  {
    for (std::size_t part = 0; part < block.tables.size(); ++part)
    {
      const unsigned int index = made->GetNumberOfBlocks();
      made->SetBlock(index, block.tables[part]);
      const std::string name =
        block.tables.size() == 1 ? block.name : block.name + " " + std::to_string(part);
      if (!block.name.empty())
      {
        made->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
      }
    }
  }
  return made->GetNumberOfBlocks() > 0 ? vtkSmartPointer<vtkDataObject>(made) : nullptr;
}

} // namespace

void BlockTables::Exchange(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* information = outputs->GetInformationObject(port);
    vtkDataObject* output = information->Get(vtkDataObject::DATA_OBJECT());
    if (const vtkSmartPointer<vtkDataObject> tables = AsMultiBlock(output))
    {
      exchanged_.push_back({ port, output, tables });
      information->Set(vtkDataObject::DATA_OBJECT(), tables);
    }
  }
}

void BlockTables::PutBack(vtkInformationVector* outputs)
{
  for (const Exchanged& output : exchanged_)
  {
    vtkInformation* information = outputs->GetInformationObject(output.port);
    if (information->Get(vtkDataObject::DATA_OBJECT()) == output.tables)
    {
      information->Set(vtkDataObject::DATA_OBJECT(), output.own);
    }
  }
  exchanged_.clear();
}

} // namespace gridfem
