(** * thick-front: Total depth 50, nearly all the light from the near end

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  100 - 100 * s.
Definition emission (s : R) : R :=
  1 + 1 / 100 * (100 * s - 50 * s ^ 2) ^ 2.
Definition exact_depth (lambda : R) : R :=
  100 * lambda - 50 * lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  51 / 50 - (51 / 50 + 1 / 50 * (100 * lambda - 50 * lambda ^ 2) + 1 / 100 * (100 * lambda - 50 * lambda ^ 2) ^ 2) * exp (- (100 * lambda - 50 * lambda ^ 2)).

Theorem thick_front (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
