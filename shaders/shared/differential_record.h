#ifndef ARGAND_SHARED_DIFFERENTIAL_RECORD_H
#define ARGAND_SHARED_DIFFERENTIAL_RECORD_H

#include "shared/differential.h"

ARGAND_SHARED_BEGIN

// PhotonDifferential of a photon that is being traced, one per slot.
struct DifferentialRecord {
    float32 dp_du_x, dp_du_y, dp_du_z;
    float32 dd_du_x, dd_du_y, dd_du_z;
    float32 dp_dv_x, dp_dv_y, dp_dv_z;
    float32 dd_dv_x, dd_dv_y, dd_dv_z;
};

FN DifferentialRecord differential_record(IN(PhotonDifferential) d) {
    DifferentialRecord r;
    r.dp_du_x = float32(d.dp_du.x);
    r.dp_du_y = float32(d.dp_du.y);
    r.dp_du_z = float32(d.dp_du.z);
    r.dd_du_x = float32(d.dd_du.x);
    r.dd_du_y = float32(d.dd_du.y);
    r.dd_du_z = float32(d.dd_du.z);
    r.dp_dv_x = float32(d.dp_dv.x);
    r.dp_dv_y = float32(d.dp_dv.y);
    r.dp_dv_z = float32(d.dp_dv.z);
    r.dd_dv_x = float32(d.dd_dv.x);
    r.dd_dv_y = float32(d.dd_dv.y);
    r.dd_dv_z = float32(d.dd_dv.z);
    return r;
}

FN PhotonDifferential load_differential(IN(DifferentialRecord) r) {
    PhotonDifferential d;
    d.dp_du = vec3(r.dp_du_x, r.dp_du_y, r.dp_du_z);
    d.dd_du = vec3(r.dd_du_x, r.dd_du_y, r.dd_du_z);
    d.dp_dv = vec3(r.dp_dv_x, r.dp_dv_y, r.dp_dv_z);
    d.dd_dv = vec3(r.dd_dv_x, r.dd_dv_y, r.dd_dv_z);
    return d;
}

ARGAND_SHARED_END

#endif
