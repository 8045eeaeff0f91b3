(** * deep-growing: A long ray through a medium that grows denser steadily

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module even.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 2500 * s.
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  1 / 5000 * lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  1 - exp (-1 / 5000 * lambda ^ 2).

Theorem deep_growing_even (D : R) :
  0 <= D <= 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End even.

Module rising.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 2500 * s.
Definition emission (s : R) : R :=
  1 + 1 / 5000 * s ^ 2.
Definition exact_depth (lambda : R) : R :=
  1 / 5000 * lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + 1 / 5000 * lambda ^ 2) * exp (-1 / 5000 * lambda ^ 2).

Theorem deep_growing_rising (D : R) :
  0 <= D <= 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End rising.

Module sloping.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 2500 * s.
Definition emission (s : R) : R :=
  1 + 1 / 250000 * s ^ 2.
Definition exact_depth (lambda : R) : R :=
  1 / 5000 * lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  51 / 50 - (51 / 50 + 1 / 250000 * lambda ^ 2) * exp (-1 / 5000 * lambda ^ 2).

Theorem deep_growing_sloping (D : R) :
  0 <= D <= 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End sloping.

Module curved.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 2500 * s.
Definition emission (s : R) : R :=
  1 + 1 / 100000000 * s ^ 4.
Definition exact_depth (lambda : R) : R :=
  1 / 5000 * lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  3 / 2 - (3 / 2 + 1 / 10000 * lambda ^ 2 + 1 / 4 * (1 / 5000 * lambda ^ 2) ^ 2) * exp (-1 / 5000 * lambda ^ 2).

Theorem deep_growing_curved (D : R) :
  0 <= D <= 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End curved.
