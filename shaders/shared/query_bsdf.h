#ifndef ARGAND_SHARED_QUERY_BSDF_H
#define ARGAND_SHARED_QUERY_BSDF_H

#include "shared/bsdf.h"
#include "shared/query_record.h"

ARGAND_SHARED_BEGIN

// direction: towards the eye; both vectors are packed by pack_unit.
FN QueryBsdfRecord query_bsdf(IN(MaterialRecord) m, uint direction, uint shading_normal) {
    return QueryBsdfRecord(m.base_r, m.base_g, m.base_b, m.metallic, m.specular_r, m.specular_g,
                           m.specular_b, m.specular, m.roughness, m.transmission, m.ior,
                           m.thickness, m.coverage, m.exponent, direction, shading_normal);
}

// The material with which bsdf_eval gives the diffuse and glossy lobes at a query; it does not
// emit. features: complement of MaterialRecord::absent.
FN MaterialRecord material_of_query(IN(QueryBsdfRecord) q, uint features) {
    return MaterialRecord(q.base_r, q.base_g, q.base_b, q.metallic, q.specular_r, q.specular_g,
                          q.specular_b, q.specular, float32(0.0), float32(0.0), float32(0.0), 0u,
                          q.roughness, q.transmission, q.ior, q.thickness, q.coverage, q.exponent,
                          ~features, 0u);
}

ARGAND_SHARED_END

#endif
