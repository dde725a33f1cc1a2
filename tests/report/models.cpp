// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "models.hpp"

namespace impinge::test {

std::string ifc_of_two_walls() {
  return R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('two.ifc','2024-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('IFC2X3'));
ENDSEC;
DATA;
#1=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',#2,'p',$,$,$,$,(#10),#20);
#2=IFCOWNERHISTORY(#3,#6,$,.ADDED.,$,$,$,0);
#3=IFCPERSONANDORGANIZATION(#4,#5,$);
#4=IFCPERSON($,'n',$,$,$,$,$,$);
#5=IFCORGANIZATION($,'o',$,$,$);
#6=IFCAPPLICATION(#5,'1','a','a');
#10=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#11,$);
#11=IFCAXIS2PLACEMENT3D(#12,$,$);
#12=IFCCARTESIANPOINT((0.,0.,0.));
#20=IFCUNITASSIGNMENT((#21));
#21=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);
#30=IFCSITE('1Qvf0xqDT4HXo8jI81mHB$',#2,'site',$,$,#31,$,$,.ELEMENT.,$,$,$,$,$);
#31=IFCLOCALPLACEMENT($,#11);
#32=IFCBUILDING('1Qvf0xqDT4HXo8jI81mHB1',#2,'house',$,$,#33,$,$,.ELEMENT.,$,$,$);
#33=IFCLOCALPLACEMENT(#31,#11);
#34=IFCBUILDINGSTOREY('1Qvf0xqDT4HXo8jI81mHB2',#2,'Level 1, north',$,$,#35,$,$,.ELEMENT.,0.);
#35=IFCLOCALPLACEMENT(#33,#11);
#40=IFCRELAGGREGATES('2Qvf0xqDT4HXo8jI81mHB$',#2,$,$,#1,(#30));
#42=IFCRELAGGREGATES('2Qvf0xqDT4HXo8jI81mHB1',#2,$,$,#30,(#32));
#43=IFCRELAGGREGATES('2Qvf0xqDT4HXo8jI81mHB2',#2,$,$,#32,(#34));
#41=IFCRELCONTAINEDINSPATIALSTRUCTURE('3Qvf0xqDT4HXo8jI81mHB$',#2,$,$,(#50,#60),#34);
#50=IFCBUILDINGELEMENTPROXY('1srAI$R4T8ihLXSNHmUSET',#2,'left',$,$,#51,#52,'-7',$);
#51=IFCLOCALPLACEMENT(#31,#56);
#52=IFCPRODUCTDEFINITIONSHAPE($,$,(#53));
#53=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#54));
#54=IFCEXTRUDEDAREASOLID(#55,#11,#58,2000.);
#55=IFCRECTANGLEPROFILEDEF(.AREA.,$,#59,2000.,2000.);
#56=IFCAXIS2PLACEMENT3D(#57,$,$);
#57=IFCCARTESIANPOINT((5000.,3000.,0.));
#58=IFCDIRECTION((0.,0.,1.));
#59=IFCAXIS2PLACEMENT2D(#70,$);
#70=IFCCARTESIANPOINT((0.,0.));
#60=IFCBUILDINGELEMENTPROXY('2O2Fr$t4X7Zf8NOew3FNr2',#2,'right',$,'type',#61,#62,$,$);
#61=IFCLOCALPLACEMENT(#31,#66);
#62=IFCPRODUCTDEFINITIONSHAPE($,$,(#63));
#63=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#64));
#64=IFCEXTRUDEDAREASOLID(#55,#11,#58,2000.);
#66=IFCAXIS2PLACEMENT3D(#67,$,$);
#67=IFCCARTESIANPOINT((6000.,4000.,1000.));
#71=IFCMATERIAL('brick');
#72=IFCMATERIAL('mortar');
#73=IFCMATERIAL('steel');
#74=IFCMATERIALLIST((#71,#72));
#75=IFCRELASSOCIATESMATERIAL('3Qvf0xqDT4HXo8jI81mHB1',#2,$,$,(#50),#74);
#76=IFCRELASSOCIATESMATERIAL('3Qvf0xqDT4HXo8jI81mHB2',#2,$,$,(#60),#73);
ENDSEC;
END-ISO-10303-21;
)";
}

std::string collada_of_two_walls() {
  const std::string node = R"(<instance_geometry url="#cube"/></node>)";
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2024-01-01T00:00:00Z</created><modified>2024-01-01T00:00:00Z</modified>
<unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="cube" name="cube"><mesh>
<source id="p"><float_array id="pa" count="24">0 0 0 2000 0 0 0 2000 0 2000 2000 0
0 0 2000 2000 0 2000 0 2000 2000 2000 2000 2000</float_array>
<technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s" name="s">
<node id="left" name="left"><translate>4000 2000 0</translate>)" +
         node + R"(
<node id="right" name="right"><translate>5000 3000 1000</translate>)" +
         node + R"(
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";
}

}  // namespace impinge::test
