// A photon, or a side of an area sample, of this batch.
struct LinkedPlace {
    uint slot;
    uint side; // 1: the back of an area sample
    vec3 p;
    vec3 normal; // of that side
};

FN LinkedPlace linked_place(uint i) {
    uint item = params.first + i;
    LinkedPlace place;
    uint first_record = params.sides == 2u ? counters[counter_stored_slots] : 0u;
    place.slot = first_record + item / params.sides;
    place.side = item % params.sides;
    PhotonRecord record = photons[place.slot];
    place.p = vec3(record.x, record.y, record.z);
    vec3 front = unpack_photon_normal(record.normal);
    place.normal = place.side == 0u ? front : -front;
    return place;
}
