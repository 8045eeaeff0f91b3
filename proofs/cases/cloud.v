(** * cloud: A cloud whose extinction fades out smoothly at both ends

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  60 * s ^ 2 - 120 * s ^ 3 + 60 * s ^ 4.
Definition emission (s : R) : R :=
  1 + 20 * s ^ 3 - 30 * s ^ 4 + 12 * s ^ 5.
Definition exact_depth (lambda : R) : R :=
  20 * lambda ^ 3 - 30 * lambda ^ 4 + 12 * lambda ^ 5.
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + 20 * lambda ^ 3 - 30 * lambda ^ 4 + 12 * lambda ^ 5) * exp (- (20 * lambda ^ 3 - 30 * lambda ^ 4 + 12 * lambda ^ 5)).

Theorem cloud (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
