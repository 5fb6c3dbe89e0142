// What a few pixels show at the instance's distance, in local lengths: no tolerance needs to be smaller.
flat in float instance_tolerance;
