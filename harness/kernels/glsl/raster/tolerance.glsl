// The length that a few pixels show at the instance's distance, in local units; no tolerance needs to be smaller.
flat in float instance_tolerance;
